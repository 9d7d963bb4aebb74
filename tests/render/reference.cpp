#include "tests/render/reference.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "node/geometry/meshlets.h"
#include "node/geometry/scene.h"
#include "node/shape/dice.h"
#include "node/simd/instruction_set.h"

namespace mars::test {
namespace {

using geometry::Triangle;

std::uint32_t interval_of(const wire::FilmView& film, std::uint32_t frame) {
  std::uint32_t i = 0;
  while (frame >= film.intervals()[i].first_frame + film.intervals()[i].frame_count) ++i;
  return i;
}

float value_at(const Triangle& t, shape::Value value, std::int32_t x, std::int32_t y) {
  const float row = t.at_first[value] + static_cast<float>(y - t.first_y) * t.per_y[value];
  return row + static_cast<float>(x - t.first_x) * t.per_x[value];
}

// Lower comes first and wins ties.
auto order(const Reference& reference, std::size_t triangle) {
  return std::make_tuple(bool{reference.moving[triangle]}, reference.triangles[triangle].record.patch, triangle);
}

struct Surfaces {
  shape::Dicer dicer{simd::best_instruction_set("sse2")};
  geometry::MeshletPlacer placer{simd::best_instruction_set("sse2")};
};

// The triangles of all patches and meshlets of the segment, seen or not.
void add_segment(const geometry::Scene& scene, std::size_t segment, Surfaces& surfaces, Reference& reference) {
  const wire::FilmView& film = scene.film();
  const wire::Shape& shape = film.shapes()[film.segments()[segment].shape];
  const shape::EyeMatrix matrix = scene.matrix(segment);
  const std::uint32_t material = scene.material(segment);
  raster::PatchIdentity identity{scene.first_patch(segment), material, shape::mirrors(matrix),
                                 film.materials()[material].sides == 1, scene.moves(segment)};
  const auto add = [&](const shape::Surface& surface) {
    const auto made = raster::plain_set_up(surface, scene.projection(), identity);
    reference.triangles.insert(reference.triangles.end(), made.begin(), made.end());
    reference.moving.resize(reference.triangles.size(), identity.moving);
    ++identity.patch;
  };
  for (const wire::Patch& patch : film.patches().subspan(shape.first_patch, shape.patch_count)) {
    surfaces.dicer.dice(shape::to_eye(matrix, patch), scene.projection(), static_cast<int>(film.settings().dice));
    add(surfaces.dicer);
  }
  for (const wire::Meshlet& meshlet : film.meshlets().subspan(shape.first_meshlet, shape.meshlet_count)) {
    surfaces.placer.place(geometry::eye_map(matrix), film, meshlet, scene.projection());
    add(surfaces.placer);
  }
}

void draw(Reference& reference, std::size_t number, std::int32_t width, std::int32_t height) {
  const auto& [t, record, index, faces] = reference.triangles[number];
  const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
  const auto sample = [](std::int32_t place) { return (place - 128) / 256; };
  for (std::int32_t row = std::max(sample(top) - 1, 0); row <= std::min(sample(bottom) + 1, height - 1); ++row)
    for (std::int32_t column = std::max(sample(left) - 1, 0); column <= std::min(sample(right) + 1, width - 1);
         ++column) {
      const std::int32_t x = 256 * column + 128, y = 256 * row + 128;
      if (!raster::covers(t, column, row)) continue;
      ReferenceSample& here =
          reference.samples[static_cast<std::size_t>(row) * reference.width + static_cast<std::size_t>(column)];
      const float depth = value_at(record, shape::kDepth, x, y);
      const bool nearer = depth > here.depth || (here.triangle && depth == here.depth &&
                                                 order(reference, number) < order(reference, *here.triangle));
      if (nearer) here = {number, depth};
    }
}

struct Vec {
  double x, y, z;
};
double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec unit(const Vec& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? Vec{a.x / length, a.y / length, a.z / length} : Vec{0, 0, 0};
}

}  // namespace

Reference draw_reference(const wire::FilmView& film, std::uint32_t frame) {
  geometry::Scene scene(film);
  scene.set_interval(interval_of(film, frame));
  scene.set_frame(frame);
  Surfaces surfaces;
  Reference reference;
  reference.width = film.settings().width;
  for (std::size_t s = 0; s < film.segments().size(); ++s) add_segment(scene, s, surfaces, reference);
  reference.samples.resize(std::size_t{reference.width} * film.settings().height);
  for (std::size_t i = reference.triangles.size(); i-- > 0;) draw(reference, i, scene.width(), scene.height());
  return reference;
}

Color shade_reference(const wire::FilmView& film, std::uint32_t frame, const Reference& reference, std::uint32_t column,
                      std::uint32_t row) {
  geometry::Scene scene(film);
  scene.set_frame(frame);
  const ReferenceSample& sample = reference.at(column, row);
  const Triangle& t = reference.triangles[*sample.triangle].record;
  const auto x = static_cast<std::int32_t>(256 * column + 128), y = static_cast<std::int32_t>(256 * row + 128);
  const Vec n = unit(
      {value_at(t, shape::kNormalX, x, y), value_at(t, shape::kNormalY, x, y), value_at(t, shape::kNormalZ, x, y)});
  const shape::Projection& p = scene.projection();
  const double dx = (column + 0.5 - p.center[0]) / p.scale, dy = (row + 0.5 - p.center[1]) / p.scale;
  const Vec eye = unit({-dx, dy, 1});
  const wire::Material& m = film.materials()[t.material];
  Color color{};
  for (int c = 0; c < 3; ++c) color.channel[c] = m.ambient * m.color[static_cast<std::size_t>(c)];
  for (const geometry::EyeLight& light : scene.lights()) {
    Vec to{light.vector[0], light.vector[1], light.vector[2]};
    const double w = 1 / sample.depth;
    if (light.kind != wire::LightKind::directional) to = unit({to.x - dx * w, to.y + dy * w, to.z + w});
    const double facing = dot(n, to);
    if (facing <= 0) continue;
    const double mirrored = 2 * facing * dot(n, eye) - dot(to, eye);
    const double highlight = mirrored > 0 ? std::pow(std::min(mirrored, 1.0), m.exponent) : 0;
    for (int c = 0; c < 3; ++c)
      color.channel[c] +=
          (m.diffuse * m.color[static_cast<std::size_t>(c)] * facing + m.specular * highlight) * light.color[c];
  }
  for (double& channel : color.channel) channel = 255 * std::clamp(channel, 0.0, 1.0);
  return color;
}

}  // namespace mars::test
