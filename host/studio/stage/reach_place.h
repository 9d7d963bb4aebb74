// Where figures can be pulled, and what then turns.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "host/content/animator/motion/body/pull.h"
#include "host/studio/project/project.h"
#include "host/studio/stage/selected.h"

namespace mars::studio {

// Whether anything moves where the joint, or the actor as a whole, is pulled.
bool can_reach(const Project& project, const Selection& selection);

// The place at which arrows pull it: the joint's end, or the actor's own place. None: it cannot reach.
std::optional<glm::dvec3> reach_place(const Project& project, const Selection& selection);

// The joint's end in its frame: the middle of the face of its rigid segment that is farthest from it; without one, the
// middle of the joints that hang on it elsewhere than in it; itself where nothing carries it or nothing hangs on it.
glm::dvec3 end_of(const modeler::Model& model, std::size_t joint);

// The ankle that carries the joint or is it; none: no ankle does.
std::optional<std::size_t> ankle_of(const modeler::Model& model, std::size_t joint);

// What turns where an actor is pulled while `pins` of its joints stay.
motion::Chain reach_chain(const Project& project, const Selection& selection, const std::vector<std::size_t>& pins);

}  // namespace mars::studio
