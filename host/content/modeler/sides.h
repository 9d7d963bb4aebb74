// Left and right of a figure, which looks along x, its left being +y: which joints are of a side, which is whose
// counterpart, and how names say it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/content/modeler/model.h"

namespace mars::modeler {

constexpr Side other(Side side) { return side == Side::left ? Side::right : Side::left; }
std::string name_of(Side side);

// "right-shin" of "left-shin", "arm.R" of "arm.L"; "" where the name has no side.
std::string other_side_name(const std::string& name);

// Of each joint: by its limb, its name, what it hangs on, or at rest where it stands; none in the middle.
std::vector<std::optional<Side>> sides_of(const Model& model);

// Of each joint of `sides_of`: the joint on the other side that is the same limb, has the other name or stands where
// it does in a mirror; kNone where there is none.
std::vector<std::size_t> counterparts_of(const Model& model);

}  // namespace mars::modeler
