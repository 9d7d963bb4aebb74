#include "host/content/animator/motion/scene.h"

#include <cmath>

#include "hal/failure/failure.h"
#include "node/wire/film_parts.h"

namespace mars::motion {

std::uint32_t Scene::last_after(double frames) const {
  const double last = at + std::ceil(frames);
  if (last < wire::kMostFrames) return static_cast<std::uint32_t>(last);
  throw Failure("would end at frame " + document::shown(last), where(),
                "begin earlier, or make it shorter: a film has at most " + std::to_string(wire::kMostFrames) +
                    " frames");
}

}  // namespace mars::motion
