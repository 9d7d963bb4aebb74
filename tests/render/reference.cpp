#include "tests/render/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <span>
#include <tuple>

#include "node/color/encoding.h"
#include "node/geometry/meshlets.h"
#include "node/geometry/scene.h"
#include "node/shape/dice.h"
#include "node/simd/instruction_set.h"
#include "tests/render/film_run.h"

namespace mars::test {
namespace {

using geometry::Triangle;

std::uint32_t interval_of(const wire::PackedFilm& film, std::uint32_t frame) {
  std::uint32_t i = 0;
  while (frame >= film.intervals()[i].first_frame + film.intervals()[i].frame_count) ++i;
  return i;
}

float depth_at(const Triangle& t, std::int32_t x, std::int32_t y) {
  const float row = t.at_first[shape::kDepth] + static_cast<float>(y - t.first_y) * t.per_y[shape::kDepth];
  return row + static_cast<float>(x - t.first_x) * t.per_x[shape::kDepth];
}

// Of triangles of one layer: lower comes first and wins ties.
auto order(const Reference& reference, std::size_t triangle) {
  return std::make_tuple(reference.triangles[triangle].record.patch, triangle);
}

struct Surfaces {
  shape::Dicer dicer{simd::best_instruction_set("sse2")};
  geometry::MeshletPlacer placer{simd::best_instruction_set("sse2")};
};

// The triangles of all patches and meshlets of the segment, seen or not.
void add_segment(const geometry::Scene& scene, std::size_t segment, Surfaces& surfaces, Reference& reference) {
  const wire::PackedFilm& film = scene.film();
  const wire::Shape& shape = film.shapes()[film.segments()[segment].shape];
  geometry::SegmentPlace place;
  place.find(scene, segment);
  const std::uint32_t material = scene.material(segment);
  raster::PatchIdentity identity{scene.first_patch(segment), material, false, film.materials()[material].sides == 1,
                                 scene.moves(segment)};
  const auto add = [&](const shape::Surface& surface) {
    const std::size_t piece = identity.patch - scene.first_patch(segment);
    identity.moving = scene.moves(segment, piece);
    identity.mirrored = place.mirrors(film, piece);
    const auto made = raster::plain_set_up(surface, scene.projection(), identity, scene.casting_count() > 0);
    reference.triangles.insert(reference.triangles.end(), made.begin(), made.end());
    reference.moving.resize(reference.triangles.size(), identity.moving);
    ++identity.patch;
  };
  for (std::uint32_t patch = 0; patch < shape.patch_count; ++patch) {
    surfaces.dicer.dice(place.patch(film, patch), scene.projection(), scene.dicing());
    add(surfaces.dicer);
  }
  for (const wire::Meshlet& meshlet : film.meshlets().subspan(shape.first_meshlet, shape.meshlet_count)) {
    surfaces.placer.place(place, film, meshlet, scene.projection());
    add(surfaces.placer);
  }
}

// Draws one triangle into its layer.
void draw(Reference& reference, std::size_t number, std::int32_t width, std::int32_t height) {
  const raster::PlainTriangle& triangle = reference.triangles[number];
  const raster::Corners& t = triangle.corners;
  std::vector<ReferenceSample>& layer = reference.moving[number] ? reference.movers : reference.still;
  const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
  const std::int32_t last_row = std::min(bottom / 256 + 1, height), last_column = std::min(right / 256 + 1, width);
  for (std::int32_t row = std::max(top / 256 - 1, 0); row < last_row; ++row)
    for (std::int32_t column = std::max(left / 256 - 1, 0); column < last_column; ++column)
      for (std::int32_t s = 0; s < reference.pattern.count; ++s) {
        const std::int32_t x = 256 * column + reference.pattern.x[s], y = 256 * row + reference.pattern.y[s];
        if (!raster::covers_place(t, x, y)) continue;
        ReferenceSample& here =
            layer[reference.first_sample(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)) +
                  static_cast<std::size_t>(s)];
        const float depth = depth_at(triangle.record, x, y);
        const bool nearer = depth > here.depth || (here.triangle && depth == here.depth &&
                                                   order(reference, number) < order(reference, *here.triangle));
        if (nearer) here = {number, depth};
      }
}

int difference(std::uint32_t a, std::uint32_t b) {
  int most = 0;
  for (int shift = 0; shift < 24; shift += 8)
    most = std::max(most, std::abs(static_cast<int>(a >> shift & 255) - static_cast<int>(b >> shift & 255)));
  return most;
}

}  // namespace

Reference draw_reference(const wire::PackedFilm& film, std::uint32_t frame) {
  geometry::Scene scene(film);
  scene.set_interval(interval_of(film, frame));
  scene.set_frame(frame);
  Surfaces surfaces;
  Reference reference;
  reference.width = film.settings().width;
  reference.pattern = shape::sample_pattern(film.settings().samples);
  for (std::size_t s = 0; s < film.segments().size(); ++s) add_segment(scene, s, surfaces, reference);
  reference.still.resize(reference.first_sample(0, film.settings().height), {{}, scene.projection().nothing});
  reference.movers.resize(reference.still.size(), reference.still.front());
  for (std::size_t i = reference.triangles.size(); i-- > 0;) draw(reference, i, scene.width(), scene.height());
  for (std::size_t k = 0; k < reference.movers.size(); ++k)
    if (!(reference.movers[k].depth > reference.still[k].depth)) reference.movers[k] = {};
  return reference;
}

std::vector<ReferenceGroup> Reference::groups(std::uint32_t column, std::uint32_t row) const {
  std::vector<ReferenceGroup> out;
  const std::size_t first = first_sample(column, row);
  const auto add_layer = [&](const std::vector<ReferenceSample>& layer, bool covered_by_movers) {
    const auto begin = static_cast<std::ptrdiff_t>(out.size());
    for (const std::uint32_t s : std::span(pattern.by_distance).first(static_cast<std::size_t>(pattern.count))) {
      if (!layer[first + s].triangle) continue;
      const std::size_t triangle = *layer[first + s].triangle;
      auto group =
          std::find_if(out.begin() + begin, out.end(), [&](const ReferenceGroup& g) { return g.triangle == triangle; });
      if (group == out.end()) group = out.insert(out.end(), {triangle, s, 0});
      group->seen += !(covered_by_movers && movers[first + s].triangle);
    }
  };
  add_layer(still, true);
  add_layer(movers, false);
  return out;
}

Color resolve_reference(const Reference& reference, const ReferenceShading& shading, std::uint32_t column,
                        std::uint32_t row) {
  const shape::SamplePattern& pattern = reference.pattern;
  Color sum{};
  std::uint32_t left = static_cast<std::uint32_t>(pattern.count);
  const auto add = [&](const Color& light, std::uint32_t samples) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += samples * light[c];
    left -= samples;
  };
  for (const ReferenceGroup& group : reference.groups(column, row)) {
    const auto x = static_cast<std::int32_t>(256 * column) + pattern.x[group.sample];
    const auto y = static_cast<std::int32_t>(256 * row) + pattern.y[group.sample];
    add(shading.shade(reference.triangles[group.triangle], x, y), group.seen);
  }
  const auto& background = shading.settings().background;
  add({background[0], background[1], background[2]}, left);
  for (double& channel : sum) channel /= pattern.count;
  return sum;
}

std::vector<std::uint32_t> reference_pixels(const Reference& reference, const ReferenceShading& shading) {
  const wire::FilmSettings& settings = shading.settings();
  const color::Encoding encoding = color::encoding_of(settings, shading.camera(), wire::PixelFormat::rgb8);
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t row = 0; row < settings.height; ++row)
    for (std::uint32_t column = 0; column < settings.width; ++column) {
      const Color light = resolve_reference(reference, shading, column, row);
      const float rounded[] = {static_cast<float>(light[0]), static_cast<float>(light[1]),
                               static_cast<float>(light[2])};
      pixels.push_back(static_cast<std::uint32_t>(color::pixel_of(encoding, rounded)));
    }
  return pixels;
}

void expect_as_reference(const wire::FilmData& film, std::uint32_t frame, int nodes) {
  const FilmBlock block(film);
  RunOptions options;
  options.nodes = nodes;
  const Pixels pixels = run_film(block.bytes(), options).frames.at(frame);
  const Reference reference = draw_reference(block.view(), frame);
  const Pixels expected = reference_pixels(reference, {block.view(), frame});
  ASSERT_EQ(pixels.size(), expected.size());
  int most = 0;
  for (std::size_t k = 0; k < pixels.size(); ++k) most = std::max(most, difference(pixels[k], expected[k]));
  EXPECT_LE(most, 1) << "frame " << frame << ", " << film.settings.samples << " samples";
}

}  // namespace mars::test
