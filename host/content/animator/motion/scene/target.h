// Things of the film that an action is about: actors, and joints of them.
#pragma once

#include <string>

#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

struct Target {
  std::size_t actor;
  std::size_t joint = modeler::kNone;  // of its model; none: the actor itself
};

// Of a parameter's word ACTOR or ACTOR/JOINT; none where it is not given. Throws where the film has no such thing.
std::optional<Target> target_of(const Scene& scene, std::string_view parameter);
// The joint of the model, or a Failure.
std::size_t joint_named(const Scene& scene, const modeler::Model& model, std::string_view parameter,
                        const std::string& name);

std::string name_of(const animator::Film& film, const Target& target);

// Where it is at a frame: a joint's place, or the middle of the box around an actor, whose skins are bent.
glm::dvec3 place_of(const animator::Film& film, const Target& target, std::uint32_t frame);

// A box in the world, along axes of its own.
struct Block {
  glm::dvec3 middle{0, 0, 0};
  glm::dmat3 axes{1};        // unit vectors, right angles
  glm::dvec3 half{0, 0, 0};  // along them

  double top() const;
  double bottom() const;
};

// Of a joint's own segment, if it has none of what of skins follows it most, or of all of an actor's, along the actor's
// axes. Skins count as they are bent. Throws where there is no segment.
Block block_of(const Scene& scene, const Target& target, std::uint32_t frame);

}  // namespace mars::motion
