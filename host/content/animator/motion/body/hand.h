// A hand that takes hold of things: which way its palm and its fingers point, and where in it a thing lies.
#pragma once

#include <string>

#include "host/content/animator/motion/body/body.h"

namespace mars::motion {

struct Hand {
  modeler::Side side;
  std::size_t shoulder, elbow;
  std::size_t end;           // the wrist, or else the elbow: in whose frame the following is
  glm::dvec3 fingers, palm;  // directions: along the hand, and out of its inner side
  glm::dvec3 grip;           // on the palm
  double upper, fore;        // lengths, the forearm's to the grip

  double length() const { return upper + fore; }
  // Where the middle of a thing lies that touches the palm at a distance `radius` from it.
  glm::dvec3 around(double radius) const { return grip + radius * palm; }
  std::vector<std::size_t> joints() const;  // from the shoulder to the end
};

// Throws where the model does not name the arm.
Hand hand_of(const Body& body, modeler::Side side, const std::string& command);

// The turn of a hand, in the world, whose palm faces along one direction and its fingers about along another.
glm::dmat3 hand_turn(const Hand& hand, const glm::dvec3& palm, const glm::dvec3& fingers);

}  // namespace mars::motion
