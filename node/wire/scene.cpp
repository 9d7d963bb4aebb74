#include "node/wire/scene.h"

#include <algorithm>
#include <span>

#include "hal/failure/failure.h"

namespace mars::wire {

std::vector<std::byte> pack_scene(const FilmData& scene) {
  check(scene.settings.frames == 1 && scene.intervals.size() == 1, "a scene is one moment");
  check(scene.mesh_places.empty() && scene.net_points.empty() && scene.skin_weights.empty() && scene.meshlets.empty(),
        "a scene's meshes and skins are the film's");
  return pack(scene);
}

// What both moving and stationary segments show stands still.
MovingParts::MovingParts(const PackedFilm& scene)
    : segments_(scene.segments().size() + scene.bones().size()),
      patches_(scene.patches().size()),
      materials_(scene.materials().size()) {
  const auto moving = scene.moving(scene.intervals().front());
  moving_ = moving.size();
  for (const std::uint32_t number : moving) segments_[number] = 1;
  for (const std::uint32_t number : scene.moving_segments(scene.intervals().front())) {
    const Segment& segment = scene.segments()[number];
    const auto bones = std::span(segments_).subspan(scene.segments().size() + segment.first_bone, segment.bone_count);
    segments_[number] = std::ranges::count(bones, std::uint8_t{0}) == 0;
  }
  const std::size_t base = scene.shape_count() - scene.shapes().size();
  for (const std::uint8_t moves : {std::uint8_t{1}, std::uint8_t{0}}) {
    std::vector<std::uint8_t> shown(scene.shapes().size());
    for (std::size_t s = 0; s < scene.segments().size(); ++s)
      if (const std::size_t shape = scene.segments()[s].shape; segments_[s] == moves && shape >= base)
        shown[shape - base] = 1;
    for (std::size_t shape = 0; shape < shown.size(); ++shape)
      if (shown[shape] == 1)
        std::ranges::fill(
            std::span(patches_).subspan(scene.shapes()[shape].first_patch, scene.shapes()[shape].patch_count), moves);
  }
}

}  // namespace mars::wire
