// Which joints are of fingers, by their names: models do not say it otherwise.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/content/modeler/model.h"

namespace mars::motion {

// The finger that a joint's name says: "thumb", "finger2"; "" if it is none.
std::string finger_of(const std::string& name);

// All joints below a hand that are named as fingers' are.
std::vector<std::size_t> finger_joints_below(const modeler::Model& model, std::size_t hand);

}  // namespace mars::motion
