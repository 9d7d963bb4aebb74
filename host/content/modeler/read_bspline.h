// B-spline surfaces of a model file (docs/model-format.md): {"points": rows along v of points along u, "u":
// {...}, "v": {...}}, each direction with degree, ends and knots.
#pragma once

#include "host/content/document/fields.h"
#include "host/content/modeler/patch_shape.h"

namespace mars::modeler {

// Whatever does not fit is refused with its place and a remedy.
PatchShape read_bspline(const document::Element& element);

}  // namespace mars::modeler
