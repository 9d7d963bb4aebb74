// Poses that a person asked for, held within the limits of joints.
#pragma once

#include <string>
#include <vector>

#include "host/content/modeler/joint.h"

namespace mars::animator {

// For the person: what was left as it is, what goes another way, what was clamped.
using Remarks = std::vector<std::string>;

// What may be outside the limits of joints: refused, or turned to the nearest that they allow.
enum class Beyond { refused, clamped };

// The nearest pose within the limits. If that is another than by rounding: throws, naming joint, axis, angle and range,
// where `beyond` refuses it; else adds a remark for each such axis. `asked`: what made the pose where that is not its
// numbers, like "turned 30 degrees about its own x", for these messages.
glm::dvec3 within_limits(const std::string& thing, const modeler::Joint& joint, const glm::dvec3& pose, Beyond beyond,
                         Remarks& remarks, const std::string& asked = "");

}  // namespace mars::animator
