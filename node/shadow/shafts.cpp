#include "node/shadow/shafts.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>

namespace mars::shadow {
namespace {

constexpr float kAnywhere = std::numeric_limits<float>::max();

// Parts of a square that several faces found.
void join_parts(std::vector<TilePart>& parts) {
  std::ranges::sort(parts, {}, &TilePart::tile);
  std::size_t last = 0;
  for (std::size_t k = 1; k < parts.size(); ++k)
    if (parts[k].tile == parts[last].tile)
      parts[last].squares |= parts[k].squares;
    else
      parts[++last] = parts[k];
  if (!parts.empty()) parts.resize(last + 1);
}

}  // namespace

// From a point at depth d to a point of the light o away from its middle, |o| <= r, a ray moves over the grid by
// |o| sqrt(1 + x^2) d / (d - |o|) for each unit of 1 / depth, x being at most 1. It is within (r + nearest) (sqrt(3) d
// + r) / (d - r) + r of the middle where it is nearer than the view's nearest depth. Near a far light's point, two
// views differ by the rounding of their grids; in views of places a difference of 1 / depth is a quarter of the
// middle's at least, for d >= 2 r.
ShaftReach reach_of(const LightViews& light, float high_z) {
  const LightView& view = light.middle.front();
  if (view.has_place == 0) return {{light.spread, light.size, 0.75f, 1, 2 / view.per_step, 0}, 0};
  if (high_z == 0) return {{0, 0, 0.25f, 0.25f, 0, 1}, -kAnywhere};
  const float r = light.size, depth = 1 / high_z;
  if (depth < 2 * r) return {{light.spread, 2 * std::numbers::sqrt2_v<float> * r, 0.25f, 0.25f, 0, 1}, kAnywhere};
  const float tangent = 1.001f * std::numbers::sqrt2_v<float> * r * depth / (depth - r);
  const float near = (r + view.nearest) * (std::numbers::sqrt3_v<float> * depth + r) / (depth - r) + r;
  return {{tangent * view.per_step, tangent, 0.25f, 0.25f, 0, 1}, 1.001f * near};
}

bool is_near(const LightViews& light, std::size_t face, const ShaftReach& reach, const Hull& hull) {
  const LightView& view = light.middle[face];
  if (view.has_place == 0 || light.size == 0) return false;
  float least = kAnywhere;  // depth
  for (std::uint32_t k = 0; k < hull.count; ++k) {
    float depth = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) depth += view.axis[axis] * (hull.along[axis][k] - view.place[axis]);
    least = std::min(least, depth);
  }
  if (least > 2 * view.nearest && reach.near < kAnywhere) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(hull.along[axis], hull.along[axis] + hull.count);
    if (*low > view.place[axis] + reach.near || *high < view.place[axis] - reach.near) return false;
  }
  return true;
}

void Shafts::begin(const LightViews& light, const PointSource& source, std::uint32_t pairs_a_sample,
                   std::span<Layer* const> layers) {
  light_ = &light;
  layers_ = layers;
  samples_ = static_cast<std::uint32_t>(source.pattern.count);
  if (points_.size() < faces()) points_.resize(faces()), touched_.resize(faces());
  for (Points& points : points_) points.clear();
  high_z_.assign(faces(), 0.0f);
  const std::uint32_t some = (1u << pairs_a_sample) - 1;
  const auto counts = [&](const wire::StillPairs& pairs, const Lane& lane, std::uint16_t moved) {
    const std::uint32_t open = pairs.lit & ~static_cast<std::uint32_t>(pairs.blocked | moved);
    return (open >> (lane.sample * pairs_a_sample) & some) != 0;
  };
  for (Layer* layer : layers)
    for (const std::uint32_t tile : layer->tiles)
      for_each_vector(source, *layer, tile, counts, light.middle,
                      [&](const PointVector& vector, std::uint32_t number, std::size_t face) {
                        high_z_[face] = std::max(high_z_[face], vector.box.high_z);
                        points_[face].add(*layer, tile, number, vector);
                      });
  for (Points& points : points_) points.finish();
  reach_.clear();
  for (const float high : high_z_) reach_.push_back(reach_of(light, high));
}

bool Shafts::meet(const Hull& hull, GridCaster& grid) {
  for (std::size_t face = 0; face < faces(); ++face) {
    if (points_[face].empty()) continue;
    if (is_near(*light_, face, reach_[face], hull)) return true;
    if (points_[face].tree().any(kernels_, grid.put(light_->middle[face], hull), reach_[face].shaft.spread))
      return true;
  }
  return false;
}

const Touched& Shafts::find(std::span<const ChunkCaster> casters, GridCaster& grid) {
  found_.casters.clear();
  if (found_.parts.size() < layers_.size()) found_.parts.resize(layers_.size());
  for (auto& parts : found_.parts) parts.clear();
  for (std::size_t face = 0; face < faces(); ++face) touched_[face].assign(points_[face].vector_count(), 0);
  std::size_t batches = 0;
  for (const ChunkCaster& caster : casters) batches += caster.surface->triangles.batch_count;
  surfaces_.clear(), kept_.clear();
  surfaces_.reserve(casters.size()), kept_.reserve(batches);
  for (const ChunkCaster& caster : casters) {
    batches_.assign((caster.surface->triangles.batch_count + kMostBatches - 1) / kMostBatches, 0);
    for (std::size_t face = 0; face < faces(); ++face)
      if (!points_[face].empty()) touch(caster, face, grid);
    keep_batches(caster);
  }
  keep_parts();
  return found_;
}

void Shafts::keep_parts() {
  for (std::size_t face = 0; face < faces(); ++face)
    points_[face].visit_squares(touched_[face], samples_, [this](const Layer* layer, const TilePart& part) {
      const auto at = static_cast<std::size_t>(std::ranges::find(layers_, layer) - layers_.begin());
      std::vector<TilePart>& parts = found_.parts[at];
      if (!parts.empty() && parts.back().tile == part.tile)
        parts.back().squares |= part.squares;
      else
        parts.push_back(part);
    });
  if (faces() > 1) std::ranges::for_each(found_.parts, join_parts);
}

void Shafts::touch(const ChunkCaster& caster, std::size_t face, GridCaster& grid) {
  const LightView& view = light_->middle[face];
  const Shaft& shaft = reach_[face].shaft;
  Points& points = points_[face];
  if (is_near(*light_, face, reach_[face], caster.hull)) return touch_all(face);
  if (!points.tree().any(kernels_, grid.put(view, caster.hull), shaft.spread)) return;
  const GridBox box = grid.put(view, *caster.surface);
  if (box.low_x > box.high_x) return;
  const std::span<std::uint32_t> below = grid.find_below(box, shaft, points);
  if (below.empty()) return;
  grid.visit_batches(
      view, *caster.surface, kEverywhere,
      [&](const SmallBatches& batches, std::uint32_t first) {
        kernels_.touch(batches, shaft, points.vectors(), below.data(), static_cast<std::uint32_t>(below.size()),
                       batches_[first / kMostBatches], touched_[face].data());
      },
      [&](std::uint32_t triangle, std::uint32_t batch) {
        const auto touch_piece = [&](const LargeTriangle& piece) {
          touch(piece, face, batches_[batch / kMostBatches], std::uint64_t{1} << batch % kMostBatches);
        };
        for_each_piece(view, *caster.surface, grid.vertices(), triangle, std::cref(touch_piece));
      });
}

void Shafts::touch_all(std::size_t face) {
  std::ranges::fill(batches_, ~std::uint64_t{0});
  std::ranges::fill(touched_[face], std::uint8_t{1});
}

void Shafts::touch(const LargeTriangle& piece, std::size_t face, std::uint64_t& touching, std::uint64_t bit) {
  Points& points = points_[face];
  const Shaft& shaft = reach_[face].shaft;
  const auto found = points.tree().find(kernels_, piece.box(), shaft.spread, found_by_large_);
  const auto touch_vector = [&](std::uint32_t vector) {
    touching |= bit;
    touched_[face][vector] = 1;
  };
  visit_behind(piece, shaft, points.vectors(), found, std::cref(touch_vector));
}

void Shafts::keep_batches(const ChunkCaster& caster) {
  const shape::Triangles& all = caster.surface->triangles;
  const std::size_t first = kept_.size();
  for (std::uint32_t b = 0; b < all.batch_count; ++b)
    if ((batches_[b / kMostBatches] >> b % kMostBatches & 1) != 0) kept_.push_back(all.batches[b]);
  if (kept_.size() == first) return;
  Caster& some = surfaces_.emplace_back(*caster.surface);
  some.triangles.batches = kept_.data() + first;
  some.triangles.batch_count = static_cast<std::uint32_t>(kept_.size() - first);
  found_.casters.push_back({caster.hull, &some, caster.patch, false});
}

}  // namespace mars::shadow
