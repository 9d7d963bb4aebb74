// A model as text, for people at a terminal: its tree of joints, how each may turn, and its segments.
#pragma once

#include <string>

#include "host/content/modeler/model.h"

namespace mars::modeler {

// Lines, each ended. Children stand two columns further right than their parent, in the file's order.
std::string describe_model(const Model& model);

// The angle between the joint's x and y axes in degrees if they are not square to each other, which shears the
// base segment; else 0.
double skew_of(const Joint& joint);

}  // namespace mars::modeler
