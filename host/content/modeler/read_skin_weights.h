// What a point of a skin follows, as model files give it.
#pragma once

#include "host/content/document/fields.h"
#include "host/content/modeler/skin_weights.h"

namespace mars::modeler {

// [bone, weight, ...], of 1 to 4 bones. The weights are divided by their sum.
VertexBones read_vertex_bones(const document::Element& element);

}  // namespace mars::modeler
