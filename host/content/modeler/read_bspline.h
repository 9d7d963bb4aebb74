// B-spline surfaces of a model file (docs/model-format.md): {"points": rows along v of points along u, "u":
// {...}, "v": {...}}, each direction with degree, ends and knots.
#pragma once

#include <vector>

#include "host/content/document/fields.h"
#include "node/wire/film_parts.h"

namespace mars::modeler {

// The surface as patches, never none. Whatever does not fit is refused with its place and a remedy.
std::vector<wire::Patch> read_bspline(const document::Element& element);

}  // namespace mars::modeler
