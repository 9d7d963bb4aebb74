// How an actor stands at a frame, whatever moves it: for tools and the studio, which compute no pose, limit or
// matrix of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "host/content/animator/pose/film.h"

namespace mars::animator {

struct ActorState {
  glm::dvec3 place, turn;                             // of the whole figure in the world; 0 if matrices move it
  modeler::Axes root;                                 // the same as a frame
  std::vector<glm::dvec3> pose;                       // of each joint, degrees, as the film file would say it
  std::vector<modeler::Axes> joints;                  // where each stands in the world; none if matrices move it
  std::vector<std::optional<wire::Matrix>> segments;  // of each joint, the T-matrix of its segment, if it has one
  std::vector<std::vector<wire::Matrix>> bones;       // of each joint, those of its segment's bones, if it has a skin
};

// `number` is the actor's in the film. Bit for bit what the compiled film has.
ActorState state_at(const Film& film, std::size_t number, std::uint32_t frame);

}  // namespace mars::animator
