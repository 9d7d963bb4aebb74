#include "tests/bench/tables/machine1992/crossings.h"

#include <algorithm>

#include "node/raster/outline.h"
#include "node/simd/instruction_set.h"

namespace mars::machine1992 {
namespace {

// Twice the area; negative where the polygon's outside is turned to the eye.
std::int64_t determinant(const shape::Vertices& v, const shape::Corner3& t) {
  const std::int64_t x1 = v.x[t.b] - v.x[t.a], x2 = v.x[t.c] - v.x[t.a];
  const std::int64_t y1 = v.y[t.b] - v.y[t.a], y2 = v.y[t.c] - v.y[t.a];
  return x1 * y2 - x2 * y1;
}

}  // namespace

Crossings::Crossings(const wire::PackedFilm& film)
    : pattern_(shape::sample_pattern(film.settings().samples)),
      dicer_(simd::best_instruction_set("")),
      placer_(simd::best_instruction_set("")),
      lines_{std::vector<std::uint32_t>(film.settings().height), std::vector<std::uint32_t>(film.settings().height)} {}

void Crossings::count(const geometry::Scene& scene, const node::Scatter& scatter, bool stationary) {
  polygons_ = drawn_ = 0;
  for (auto& lines : lines_) std::ranges::fill(lines, 0u);
  for (std::size_t s = 0; s < scene.film().segments().size(); ++s)
    if (stationary || scene.moves(s)) add_segment(scene, s, scatter);
}

void Crossings::add_segment(const geometry::Scene& scene, std::size_t segment, const node::Scatter& scatter) {
  const wire::PackedFilm& film = scene.film();
  const std::uint32_t number = film.segments()[segment].shape;
  const wire::Shape& shape = film.shape(number);
  const shape::EyeMatrix matrix = scene.matrix(segment);
  const shape::EyeMap map = geometry::eye_map(matrix);
  const Sides sides{scene.moves(segment), film.materials()[scene.material(segment)].sides == 1, shape::mirrors(matrix)};
  for (std::uint32_t i = 0; i < shape.size(); ++i) {
    if ((scene.first_patch(segment) + i) % scatter.count != scatter.index) continue;
    if (i < shape.patch_count) {
      dicer_.dice(shape::to_eye(matrix, film.patches_of(number)[i]), scene.projection(), scene.dicing());
      add(dicer_, sides);
    } else {
      placer_.place(map, film, film.meshlets_of(number)[i - shape.patch_count], scene.projection());
      add(placer_, sides);
    }
  }
}

void Crossings::add(const shape::Surface& surface, const Sides& sides) {
  const shape::Vertices& v = surface.vertices();
  polygons_ += surface.triangles().count;
  for (std::uint32_t k = 0; k < surface.triangles().count; ++k) {
    const shape::Corner3 t = surface.triangles()[k];
    if (v.outside[t.a] + v.outside[t.b] + v.outside[t.c] > 0) continue;
    const std::int64_t area = determinant(v, t);
    if (area == 0 || (sides.one_sided && (area < 0) == sides.mirrored)) continue;
    const auto [top, bottom] = std::minmax({v.y[t.a], v.y[t.b], v.y[t.c]});
    const std::span<std::uint32_t> lines = on_lines(sides.moving);
    const std::int32_t first = std::max(raster::row_at_or_after(top, pattern_), 0);
    const std::int32_t last =
        std::min(raster::row_at_or_after(bottom, pattern_), static_cast<std::int32_t>(lines.size()));
    drawn_ += first < last;
    for (std::int32_t line = first; line < last; ++line) ++lines[static_cast<std::size_t>(line)];
  }
}

}  // namespace mars::machine1992
