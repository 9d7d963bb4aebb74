// A motion of one figure put on another of other joints, axes, lengths and rest pose, as files of captured motion are
// meant for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/frame_range.h"
#include "host/content/animator/pose/film.h"

namespace mars::motion {

// Whose motion, and from which of its frames.
struct MotionSource {
  const animator::Film& film;
  std::size_t actor;  // of the film
  animator::FrameRange frames;
};

// A joint that its limits keep from following.
struct Limited {
  std::string joint;
  double degrees;  // that it falls short at most
};

struct Transferred {
  std::vector<animator::ActorKey> keys;  // one each frame
  std::uint32_t first = 0, last = 0;
  std::size_t by_limb = 0, by_name = 0;  // joints that take their turns from the source
  std::vector<std::string> left_out;     // joints of the source that move and have none that stands for them
  std::vector<Limited> limited;          // joints of the target, those that fall short most first
  double scale = 1;                      // of ways, by the heights of the hips
};

// For the actor of the film from frame `at` on, where and as it faces then. Each joint turns in the world as the one
// that it matches (matching.h); where limbs rest in other directions (arms out or hanging) they point the same way.
// The hips go as far as their height over the floor is to the source's. The source's frames are sampled at the film's
// rate. Throws Failure where no joints match, matrices move one of the figures, the actor is carried at frame `at`, or
// the film would be too long.
Transferred transfer_motion(const MotionSource& source, const animator::Film& film, std::size_t actor,
                            std::uint32_t at);

}  // namespace mars::motion
