#include "tests/host/render/serve/scenes.h"

#include <algorithm>
#include <set>

#include "node/wire/scene.h"

namespace mars::test {
namespace {

// A track whose only value is this one.
wire::Track constant(wire::FilmData& scene, std::size_t value) {
  scene.changes.push_back({0, static_cast<std::uint32_t>(value)});
  return {static_cast<std::uint32_t>(scene.changes.size() - 1), 1};
}

}  // namespace

std::vector<std::byte> scene_of(const wire::PackedFilm& film, std::uint32_t frame, const Moves& moves) {
  wire::FilmData scene;
  scene.settings = film.settings();
  scene.settings.frames = 1;
  scene.cameras = {film.camera_at(frame)};
  scene.settings.camera = constant(scene, 0);
  scene.materials.assign(film.materials().begin(), film.materials().end());
  for (const wire::Track& track : film.light_tracks()) {
    scene.lights.push_back(film.lights()[film.value_at(track, frame)]);
    scene.light_tracks.push_back(constant(scene, scene.lights.size() - 1));
  }
  scene.names = {'\0'};
  for (std::uint32_t number = 0; number < film.segments().size(); ++number) {
    const wire::Segment& segment = film.segments()[number];
    scene.matrices.push_back(film.matrix_at(segment, frame));
    const wire::Track motion = constant(scene, number);
    scene.segments.push_back({segment.shape, 0, motion, constant(scene, film.value_at(segment.material, frame))});
    if (moves(number)) scene.moving.push_back(number);
  }
  scene.intervals = {{0, 1, 0, static_cast<std::uint32_t>(scene.moving.size())}};
  return wire::pack_scene(scene);
}

std::vector<wire::MovedSegment> moved_to(const wire::PackedFilm& film, std::uint32_t frame, const Moves& moves) {
  std::vector<wire::MovedSegment> moved;
  for (std::uint32_t number = 0; number < film.segments().size(); ++number) {
    const wire::Segment& segment = film.segments()[number];
    if (moves(number))
      moved.push_back({number, film.value_at(segment.material, frame), film.matrix_at(segment, frame)});
  }
  return moved;
}

Moves movers_at(const wire::PackedFilm& film, std::uint32_t frame) {
  const auto has = [&](const wire::Interval& each) {
    return frame >= each.first_frame && frame < each.first_frame + each.frame_count;
  };
  const auto moving = film.moving(*std::ranges::find_if(film.intervals(), has));
  return [numbers = std::set<std::uint32_t>(moving.begin(), moving.end())](std::uint32_t segment) {
    return numbers.contains(segment);
  };
}

}  // namespace mars::test
