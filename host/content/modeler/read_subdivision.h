// Catmull-Clark cages of a model file (docs/shapes.md): {"points": ..., "faces": ..., "level": ..., "bones": ...}.
#pragma once

#include "host/content/document/fields.h"
#include "host/content/modeler/patch_shape.h"

namespace mars::modeler {

// Whatever does not fit is refused with its place and a remedy.
PatchShape read_subdivision(const document::Element& element);

}  // namespace mars::modeler
