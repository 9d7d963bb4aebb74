// Hands that take actors and put them down.
#pragma once

#include <span>

#include "host/content/animator/motion/body/hand.h"
#include "host/content/animator/motion/scene/parameter.h"
#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

Motion pick(const Scene& scene);
Motion put(const Scene& scene);

std::span<const Parameter> pick_parameters();
std::span<const Parameter> put_parameters();

// What a figure's hand holds at the frame at which the action begins.
struct Holding {
  Hand hand;
  std::size_t actor;  // what is held
};

// By the parameters `what` and `hand`, or the only thing that it holds. Throws where it holds no such thing.
Holding holding_of(const Scene& scene, const Body& body);

// How an arm is held that carries something: from shoulder to hand, canonical turns.
std::map<std::size_t, glm::dmat3> carrying(const Body& body, const Hand& hand);

}  // namespace mars::motion
