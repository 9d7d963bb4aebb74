// Compiled films as nodes read them: PackedFilm refuses a block, or all of it can be read without harm.
#include "hal/failure/failure.h"
#include "node/geometry/meshlets.h"
#include "node/geometry/scene.h"
#include "node/geometry/sweep.h"
#include "node/simd/instruction_set.h"
#include "node/wire/film.h"
#include "tests/fuzz/edits.h"
#include "tests/fuzz/target.h"
#include "tests/node/wire/small_film.h"

namespace mars::fuzz::film_block {
namespace {

constexpr std::size_t kLongest = 1 << 16;

void read_shapes(const geometry::Scene& scene, const geometry::ShapeBoxes& boxes, std::uint32_t last) {
  static geometry::MeshletPlacer placer(simd::best_instruction_set(""));
  const wire::PackedFilm& film = scene.film();
  geometry::SegmentPlace place;
  for (const wire::Segment& segment : film.segments()) {
    place.find(scene, static_cast<std::size_t>(&segment - film.segments().data()));
    place.corners(boxes);
    film.name(segment);
    film.material_at(segment, last);
    const wire::Shape& shape = film.shapes()[segment.shape];
    for (const wire::Meshlet& meshlet : film.meshlets().subspan(shape.first_meshlet, shape.meshlet_count))
      placer.place(place, film, meshlet, scene.projection());
  }
}

// As nodes do, frame by frame.
void read_all(const wire::PackedFilm& film) {
  const std::uint32_t last = film.settings().frames - 1;
  geometry::Scene scene(film);
  const geometry::ShapeBoxes boxes(film);
  for (std::uint32_t i = 0; i < film.intervals().size(); ++i) {
    scene.set_interval(i);
    const std::uint32_t frame = film.intervals()[i].first_frame;
    scene.set_frame(frame);
    for (std::size_t segment = 0; segment < film.segments().size(); ++segment)
      check(scene.moves(segment) || scene.moving_pieces(segment) == 0, "pieces move with their segments");
    geometry::Sweep().begin(scene, {&frame, 1}, boxes, [](const geometry::PictureBounds&) {});
  }
  read_shapes(scene, boxes, last);
}

}  // namespace

void take(std::string_view input) {
  static const Message sound = wire::pack(wire::small_film());
  Message block = sound;
  Script script(input);
  while (!script.at_end()) edit(block, script, kLongest);
  read_all(wire::PackedFilm(block, "film"));
}

const Target target("film_block", Form::bytes, take);

}  // namespace mars::fuzz::film_block
