// A figure at one moment, in the numbers that a film's keys hold, and where its joints then stand.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "host/content/animator/pose/figure.h"

namespace mars::motion {

struct Posture {
  glm::dvec3 place{0, 0, 0};     // of the actor, in the world
  glm::dvec3 turn{0, 0, 0};      // of the actor, degrees as a free joint's pose
  std::vector<glm::dvec3> pose;  // one a joint, degrees
};

// All joints at zero, in the model's own frame, limits or not: the figure as its places draw it.
Posture drawn_posture(const modeler::Model& model);

// What the film shows at a frame.
Posture posture_at(const modeler::Model& model, const animator::FigureMotion& motion, std::uint32_t frame);

glm::dmat3 actor_turn(const Posture& posture);

// Where a joint stands in the world, turned as the posture says.
modeler::Axes frame_in(const modeler::Model& model, const Posture& posture, std::size_t joint);
// The same before its own turn: its parent's frame, moved to the joint's place.
modeler::Axes socket_in(const modeler::Model& model, const Posture& posture, std::size_t joint);

}  // namespace mars::motion
