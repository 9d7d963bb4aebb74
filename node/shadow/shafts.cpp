#include "node/shadow/shafts.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace mars::shadow {
namespace {

// Of a light with a place and size r, points nearer than kNearPoints r, and casters nearer than kNearCasters r and
// kNearest of the nearest depth, have no shafts: a ray from a point at depth d >= 2 r is nearer to the middle than
// (r + nearest) (2 sqrt(3) + 1) + r where it leaves the middle's view.
constexpr float kNearPoints = 2, kNearCasters = 6, kNearest = 5;

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

// Near a far light's point, two views differ by the rounding of their grids. In views of places at least two sizes away
// a difference of 1 / depth is a quarter of the middle's at least.
Shaft shaft_of(const LightViews& light) {
  const LightView& view = light.middle.front();
  const float tangent = light.spread / view.per_step;
  if (view.has_place != 0) return {light.spread, tangent, 0.25f, 0.25f, 0, 1};
  return {light.spread, tangent, 0.75f, 1, 2 / view.per_step, 0};
}

void Shafts::begin(const LightViews& light, const PointSource& source, std::uint32_t pairs_a_sample,
                   std::span<Layer* const> layers) {
  light_ = &light;
  layers_ = layers;
  samples_ = static_cast<std::uint32_t>(source.pattern.count);
  const LightView& first = light.middle.front();
  shaft_ = shaft_of(light);
  points_.resize(light.middle.size());
  for (Points& points : points_) points.clear();
  is_open_ = false;
  const std::uint32_t some = (1u << pairs_a_sample) - 1;
  const auto counts = [&](const wire::StillPairs& pairs, const Lane& lane, std::uint16_t moved) {
    const std::uint32_t open = pairs.lit & ~static_cast<std::uint32_t>(pairs.blocked | moved);
    return (open >> (lane.sample * pairs_a_sample) & some) != 0;
  };
  for (Layer* layer : layers)
    for (const std::uint32_t tile : layer->tiles)
      for_each_vector(source, *layer, tile, counts, light.middle,
                      [&](const PointVector& vector, std::uint32_t number, std::size_t face) {
                        is_open_ |= first.has_place != 0 && vector.box.high_z * kNearPoints * light.size > 1;
                        points_[face].add(*layer, tile, number, vector);
                      });
  for (Points& points : points_) points.finish();
}

bool Shafts::meet(const Hull& hull, GridCaster& grid) {
  if (is_open_ || is_near(hull)) return true;
  for (std::size_t face = 0; face < points_.size(); ++face)
    if (!points_[face].empty() &&
        points_[face].tree().any(kernels_, grid.put(light_->middle[face], hull), shaft_.spread))
      return true;
  return false;
}

bool Shafts::is_near(const Hull& hull) const {
  const LightView& view = light_->middle.front();
  if (!view.has_place) return false;
  const float reach = kNearCasters * light_->size + kNearest * view.nearest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(hull.along[axis], hull.along[axis] + hull.count);
    if (*low > view.place[axis] + reach || *high < view.place[axis] - reach) return false;
  }
  return true;
}

const Touched& Shafts::find(std::span<const ChunkCaster> casters, GridCaster& grid) {
  found_.casters.clear();
  found_.parts.assign(layers_.size(), {});
  if (is_open_ || std::ranges::any_of(casters, [this](const ChunkCaster& caster) { return is_near(caster.hull); })) {
    found_.casters.assign(casters.begin(), casters.end());
    for (std::size_t k = 0; k < layers_.size(); ++k)
      for (const std::uint32_t tile : layers_[k]->tiles) found_.parts[k].push_back({tile, TilePart::kAll});
    return found_;
  }
  touched_.resize(points_.size());
  for (std::size_t face = 0; face < points_.size(); ++face) touched_[face].assign(points_[face].vector_count(), 0);
  std::size_t batches = 0;
  for (const ChunkCaster& caster : casters) batches += caster.surface->triangles.batch_count;
  surfaces_.clear(), kept_.clear();
  surfaces_.reserve(casters.size()), kept_.reserve(batches);
  for (const ChunkCaster& caster : casters) {
    batches_.assign((caster.surface->triangles.batch_count + kMostBatches - 1) / kMostBatches, 0);
    for (std::size_t face = 0; face < points_.size(); ++face)
      if (!points_[face].empty()) touch(caster, face, grid);
    keep_batches(caster);
  }
  keep_parts();
  return found_;
}

void Shafts::keep_parts() {
  for (std::size_t face = 0; face < points_.size(); ++face)
    points_[face].visit_squares(touched_[face], samples_, [this](const Layer* layer, const TilePart& part) {
      const auto at = static_cast<std::size_t>(std::ranges::find(layers_, layer) - layers_.begin());
      std::vector<TilePart>& parts = found_.parts[at];
      if (!parts.empty() && parts.back().tile == part.tile)
        parts.back().squares |= part.squares;
      else
        parts.push_back(part);
    });
  if (points_.size() > 1) std::ranges::for_each(found_.parts, join_parts);
}

void Shafts::touch(const ChunkCaster& caster, std::size_t face, GridCaster& grid) {
  const LightView& view = light_->middle[face];
  Points& points = points_[face];
  if (!points.tree().any(kernels_, grid.put(view, caster.hull), shaft_.spread)) return;
  const GridBox box = grid.put(view, *caster.surface);
  if (box.low_x > box.high_x) return;
  const std::span<std::uint32_t> below = grid.find_below(box, shaft_, points);
  if (below.empty()) return;
  grid.visit_batches(
      view, *caster.surface,
      [&](const SmallBatches& batches, std::uint32_t first) {
        kernels_.touch(batches, shaft_, points.vectors(), below.data(), static_cast<std::uint32_t>(below.size()),
                       batches_[first / kMostBatches], touched_[face].data());
      },
      [&](std::uint32_t, std::uint32_t batch) {
        batches_[batch / kMostBatches] |= std::uint64_t{1} << batch % kMostBatches;
        for (const std::uint32_t vector : below) touched_[face][vector] = 1;
      });
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
