// A scene: one moment of a film, seen by one camera, as a live view shows it. The scene block is a packed film (film.h)
// of one frame and one interval, whose moving segments are those that the view's inbetweens may change. It has no
// meshes; its shapes and patches are those that differ from the loaded film's: shape numbers below the film's are the
// film's own, those from there on are the block's, whose patches count from the block's first.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::wire {

// The block of a scene; `scene.settings.frames` is 1.
std::vector<std::byte> pack_scene(const FilmData& scene);

}  // namespace mars::wire
