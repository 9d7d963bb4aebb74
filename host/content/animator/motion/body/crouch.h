// How a body that stands bends down: knees, hips and trunk together, its feet where they are and its weight above
// them.
#pragma once

#include <string>

#include "host/content/animator/motion/body/stance.h"

namespace mars::motion {

class Crouch {
 public:
  // Of a body as it stands; one that sits, or whose legs have no knees, bends its trunk alone.
  Crouch(const Body& body, const Posture& start, const std::string& where);
  Crouch(const Body&&, auto&&...) = delete;

  // From 0, as it stood, to 1, as low as it gets; the trunk twisted to the left, in degrees. Arms
  // hang from it, otherwise as they were. `posture` is that of the moment before, or any. Throws where feet cannot
  // stay.
  void take(double depth, double twist, Posture& posture) const;

  const Stance& standing() const { return stance_; }

 private:
  glm::dvec3 lowered(double depth) const;

  const Body& body_;
  Posture start_;
  std::string where_;
  Stance stance_;
  bool knees_;
};

}  // namespace mars::motion
