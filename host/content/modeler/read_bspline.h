// B-spline surfaces of a model file (docs/model-format.md): {"points": rows along v of points along u, "u":
// {...}, "v": {...}}, each direction with degree, ends and knots.
#pragma once

#include <vector>

#include "host/content/document/fields.h"
#include "host/content/modeler/skin_weights.h"
#include "node/wire/film_parts.h"

namespace mars::modeler {

struct SplineShape {
  std::vector<wire::Patch> patches;  // never none
  std::vector<PatchBones> bones;     // of a skin one a patch, else none
};

// Whatever does not fit is refused with its place and a remedy.
SplineShape read_bspline(const document::Element& element);

}  // namespace mars::modeler
