// Fingers that close round a thing and open again.
#pragma once

#include <map>

#include "host/content/animator/motion/body/digits.h"
#include "host/content/animator/motion/scene/solid.h"

namespace mars::motion {

// Numbers of the fingers' joints.
using Fingers = std::map<std::size_t, glm::dvec3>;

// Stretched, and closed round a thing that lies in the hand: all joints of a finger bend together from there, each
// until a part of the finger that it moves touches the thing, or to its limit. `thing` is seen from the hand's end.
// What is inside the thing when it is stretched stays stretched.
Fingers open_fingers(const modeler::Model& model, const std::vector<Digit>& digits, const Posture& now);
Fingers closed_fingers(const modeler::Model& model, const std::vector<Digit>& digits, std::size_t hand,
                       const Posture& now, const Solid& thing);
// As a hand hangs that holds nothing.
Fingers relaxed_fingers(const modeler::Model& model, const std::vector<Digit>& digits);

// `share` of the way from one to the other, into a posture.
void blend(const Fingers& from, const Fingers& to, double share, Posture& posture);
// As they are in a posture.
Fingers fingers_in(const std::vector<Digit>& digits, const Posture& posture);

}  // namespace mars::motion
