// How a figure stands before anybody animates its arms: models of other programs hold them out to the sides.
#pragma once

#include <optional>

#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

// The scene's key with which such arms hang beside the body: those that have no key of their own. None where there are
// none, or the model names too few limbs.
std::optional<animator::ActorKey> hanging_arms(const Scene& scene);

// The film with that key.
animator::Film with_key(const Scene& scene, const animator::ActorKey& key);

// Takes out joints that are no limbs, stay as they are drawn and have no key yet.
void leave_out_idle(const Scene& scene, std::vector<animator::ActorKey>& keys);

}  // namespace mars::motion
