// What is valid in a model but probably not meant: limbs that stand apart, an sbb on the wrong side of its joint, what
// nothing uses. Each in one sentence that names the joint and what to do.
#pragma once

#include <string>
#include <vector>

#include "host/content/modeler/model.h"

namespace mars::modeler {

std::vector<std::string> doubts_about(const Model& model);

}  // namespace mars::modeler
