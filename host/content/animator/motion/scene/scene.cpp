#include "host/content/animator/motion/scene/scene.h"

#include <cmath>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/actor_state.h"
#include "node/wire/film_parts.h"

namespace mars::motion {

std::uint32_t Scene::last_after(double frames) const {
  const double last = at + std::ceil(frames);
  if (last < wire::kMostFrames) return static_cast<std::uint32_t>(last);
  throw Failure("would end at frame " + document::shown(last), where(),
                "begin earlier, or make it shorter: a film has at most " + std::to_string(wire::kMostFrames) +
                    " frames");
}

Posture posture_of(const Scene& scene) {
  const auto number = static_cast<std::size_t>(&scene.actor - scene.film.actors.data());
  animator::ActorState state = animator::state_at(scene.film, number, scene.at);
  return {state.place, state.turn, std::move(state.pose)};
}

}  // namespace mars::motion
