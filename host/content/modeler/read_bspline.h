// B-spline surfaces of a model file (docs/model-format.md): {"points": rows along v of points along u, "u":
// {...}, "v": {...}}, each direction with degree, ends and knots.
#pragma once

#include <string_view>
#include <vector>

#include "host/content/document/fields.h"
#include "node/wire/film_parts.h"

namespace mars::modeler {

inline constexpr std::string_view kBSplineNames[] = {"points", "u", "v"};
inline constexpr std::string_view kDirectionNames[] = {"degree", "ends", "knots"};
inline constexpr document::Keys kBSplineKeys{"bspline", kBSplineNames};
inline constexpr document::Keys kDirectionKeys{"direction", kDirectionNames};

// The surface as patches, never none. Whatever does not fit is refused with its place and a remedy.
std::vector<wire::Patch> read_bspline(const document::Element& element);

}  // namespace mars::modeler
