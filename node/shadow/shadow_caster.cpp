#include "node/shadow/shadow_caster.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <ranges>

#include "node/shadow/block_plainly.h"
#include "node/simd/vector_slack.h"

namespace mars::shadow {
namespace {

constexpr float kPlaceError = 1.0f / (1 << 20);

float largest(const Hull& hull) {
  float most = 0;
  for (const auto& along : hull.along)
    for (std::uint32_t k = 0; k < hull.count; ++k) most = std::max(most, std::abs(along[k]));
  return most;
}

Hull hull_of(const geometry::SweptHull& swept) {
  Hull hull;
  for (std::size_t axis = 0; axis < 3; ++axis) std::ranges::copy(swept.along[axis], hull.along[axis]);
  hull.count = swept.count;
  return hull;
}

std::int32_t clamped(double steps) {
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(steps, -kMost, kMost));
}

}  // namespace

ShadowCaster::ShadowCaster(simd::InstructionSet set, const geometry::Scene& scene)
    : kernels_(shadow_kernels(set)),
      pattern_(scene.pattern()),
      samples_(static_cast<std::uint32_t>(pattern_.count)),
      hard_(pattern_, false),
      soft_(pattern_, true),
      diced_(scene.film().patch_instances()),
      casters_(set),
      grid_x_(static_cast<std::size_t>(shape::Dicer::kMostVertices + simd::kVectorSlack)),
      grid_y_(grid_x_.size()),
      grid_z_(grid_x_.size()),
      small_(new SmallBatches{}) {}

void ShadowCaster::begin(const geometry::Scene& scene, const std::function<void()>& look) {
  look_ = look;
  lights_.clear();
  for (const geometry::EyeLight& light : scene.casting_lights())
    lights_.push_back(light_views(light, scene.projection()));
}

void ShadowCaster::cast(const geometry::Scene& scene, Layers drawn, Layer& kept) {
  std::vector<Layer*> all(drawn.begin(), drawn.end());
  all.push_back(&kept);
  for (std::uint32_t light = 0; light < lights(); ++light) {
    if (!has_size(light)) {
      cast_from_point(scene, light, drawn, kept);
      continue;
    }
    cast_from_all(scene, Casting::still, light, drawn);
    if (scene.any_moves()) cast_from_all(scene, Casting::moving, light, all);
  }
}

PointSource ShadowCaster::source_of(std::uint32_t light, std::uint32_t point) const {
  return {kernels_, lights_[light].frame, pattern_, vectors_of(light), light, has_size(light) ? point : 0};
}

std::span<const LightView> ShadowCaster::views_of(std::uint32_t light, std::uint32_t point) const {
  const LightViews& all = lights_[light];
  return std::span(all.views).subspan(std::size_t{point} * all.faces, all.faces);
}

// Of a light without size: points stay on its grids while casters stream by.
void ShadowCaster::cast_from_point(const geometry::Scene& scene, std::uint32_t light, Layers drawn, Layer& kept) {
  const PointSource source = source_of(light, 0);
  const auto views = views_of(light, 0);
  put_points(source, views, drawn, drawn_points_);
  Faces* const onto[] = {&drawn_points_, &kept_points_};
  stream(scene, Casting::still, views, std::span(onto).first(1));
  for (Points& points : drawn_points_) points.note(source, Casting::still);
  if (!scene.any_moves()) return;
  Layer* const kept_alone[] = {&kept};
  put_points(source, views, kept_alone, kept_points_);
  stream(scene, Casting::moving, views, onto);
  for (Faces* faces : onto)
    for (Points& points : *faces) points.note(source, Casting::moving);
}

void ShadowCaster::stream(const geometry::Scene& scene, Casting casting, std::span<const LightView> views,
                          std::span<Faces* const> onto) {
  const auto matters = [&](const Hull& hull) {
    for (std::size_t f = 0; f < views.size(); ++f) {
      if (std::ranges::all_of(onto, [f](const Faces* faces) { return (*faces)[f].empty(); })) continue;
      const GridBox box = box_of_hull(views[f], hull);
      for (Faces* faces : onto)
        if ((*faces)[f].tree().any(kernels_, box, 0)) return true;
    }
    return false;
  };
  casters_.begin(scene, casting, diced_);
  for (auto chunk = next_casters(matters); !chunk.empty(); chunk = next_casters(matters))
    for (Faces* faces : onto) block(chunk, views, *faces);
}

// Of a light that has a size: each chunk of casters is seen from each of its points, with the points that this one
// decides about.
void ShadowCaster::cast_from_all(const geometry::Scene& scene, Casting casting, std::uint32_t light, Layers onto) {
  const LightViews& all = lights_[light];
  bounds_.clear();
  if (has_bounds(light))
    for (const Layer* layer : onto) bound(light, *layer, layer->tiles, bounds_);
  const auto matters = [&](const Hull& hull) {
    if (!has_bounds(light)) return true;
    return std::ranges::any_of(
        bounds_, [&](TileBounds& face) { return face.tree.any(kernels_, box_of_hull(all.middle, hull), all.spread); });
  };
  casters_.begin(scene, casting, diced_);
  for (auto chunk = next_casters(matters); !chunk.empty(); chunk = next_casters(matters))
    for (std::uint32_t point = 0; point < all.points; ++point) {
      const PointSource source = source_of(light, point);
      const auto views = views_of(light, point);
      put_points(source, views, onto, drawn_points_);
      block(chunk, views, drawn_points_);
      for (Points& points : drawn_points_) points.note(source, casting);
    }
}

void ShadowCaster::put_points(const PointSource& source, std::span<const LightView> views, Layers onto, Faces& faces) {
  faces.resize(views.size());
  for (Points& points : faces) points.clear();
  for (Layer* layer : onto) add_points(source, views, *layer, faces);
  for (Points& points : faces) {
    points.finish();
    counts_.points += points.count();
  }
  look_();
}

std::span<const Caster* const> ShadowCaster::next_casters(const CasterStream::Matters& matters) {
  const std::span<const Caster* const> chunk = casters_.next(matters);
  for (const Caster* caster : chunk) {
    if (!casters_.has_diced(*caster)) continue;
    ++counts_.surfaces;
    counts_.diced_vertices += caster->vertices;
  }
  return chunk;
}

void ShadowCaster::block(std::span<const Caster* const> casters, std::span<const LightView> views, Faces& faces) {
  for (std::size_t f = 0; f < views.size(); ++f) {
    if (faces[f].empty()) continue;
    for (const Caster* caster : casters) block(*caster, views[f], faces[f]);
    look_();
  }
}

void ShadowCaster::block(const Caster& caster, const LightView& view, Points& points) {
  if (!points.tree().any(kernels_, box_of_hull(view, caster.hull), 0)) return;
  const GridVertices vertices{grid_x_.data(), grid_y_.data(), grid_z_.data()};
  const GridBox box = kernels_.project(view, caster.place, caster.vertices, vertices);
  counts_.vertices += caster.vertices;
  if (box.low_x > box.high_x) return;
  const auto found = points.tree().find(kernels_, box, 0, found_);
  if (found.empty()) return;
  counts_.triangles += caster.triangles.count;
  for (std::uint32_t first = 0; first < caster.triangles.batch_count; first += kMostBatches) {
    const std::uint32_t count = std::min(kMostBatches, caster.triangles.batch_count - first);
    small_->count = 0;
    for (std::uint32_t b = 0; b < count; ++b) {
      const shape::Batch& batch = caster.triangles.batches[first + b];
      std::uint32_t large = kernels_.set_up(view, vertices, caster.triangles, batch, *small_);
      for (; large != 0; large &= large - 1)
        block_large(view, caster, batch.first + static_cast<std::uint32_t>(std::countr_zero(large)), points);
    }
    kernels_.block(*small_, points.vectors(), found.data(), static_cast<std::uint32_t>(found.size()));
  }
}

void ShadowCaster::block_large(const LightView& view, const Caster& caster, std::uint32_t triangle, Points& points) {
  const GridVertices vertices{grid_x_.data(), grid_y_.data(), grid_z_.data()};
  for_each_piece(view, caster, vertices, triangle, [&](const LargeTriangle& piece) {
    block_plainly(piece, points.vectors(), points.tree().find(kernels_, piece.box(), 0, found_by_large_));
  });
}

// A little wider, for vertices lie within the hull but for rounding.
GridBox ShadowCaster::box_of_hull(const LightView& view, const Hull& hull) {
  const float* const points[3] = {hull.along[0], hull.along[1], hull.along[2]};
  GridBox box = kernels_.project(view, points, hull.count, {grid_x_.data(), grid_y_.data(), grid_z_.data()});
  if (box.low_x > box.high_x) return box;
  const double nearer = view.has_place ? double{box.high_z} : 1.0;
  const double margin = double{largest(hull)} * kPlaceError * nearer * view.per_step;
  box.low_x = clamped(box.low_x - margin), box.high_x = clamped(box.high_x + margin);
  box.low_y = clamped(box.low_y - margin), box.high_y = clamped(box.high_y + margin);
  return box;
}

void ShadowCaster::bound(std::uint32_t light, const Layer& layer, std::span<const std::uint32_t> tiles,
                         std::vector<TileBounds>& faces) const {
  const LightViews& all = lights_[light];
  const auto views = has_size(light) ? std::span(&all.middle, 1) : views_of(light, 0);
  for (const LightView& view : views) {
    TileBounds& face = faces.emplace_back();
    face.tree.clear();
    for (const std::uint32_t tile : tiles) {
      const GridBox box = bound_tile(light, view, layer, tile);
      if (box.low_x > box.high_x) continue;
      face.tree.add(box);
      face.tiles.push_back(tile);
    }
    face.tree.finish();
  }
}

GridBox ShadowCaster::bound_tile(std::uint32_t light, const LightView& view, const Layer& layer,
                                 std::uint32_t tile) const {
  const std::uint32_t n = pairs_a_sample(light), some = (1u << n) - 1;
  GridBox box = kNowhere;
  const auto counts = [n, some](const wire::StillPairs& pairs, const Lane& lane, std::uint16_t) {
    return (pairs.lit >> (lane.sample * n) & some) != 0;
  };
  const PointSource source{kernels_, lights_[light].frame, pattern_, hard_, light, 0};
  for_each_vector(source, layer, tile, counts, std::span(&view, 1),
                  [&](const PointVector& points, std::uint32_t, std::size_t) { box = around(box, points.box); });
  return box;
}

void ShadowCaster::bound_still(const Layer& still) {
  still_lines_ = still.range;
  still_bounds_.resize(lights());
  for (std::uint32_t light = 0; light < lights(); ++light) {
    still_bounds_[light].clear();
    if (has_bounds(light)) bound(light, still, still.tiles, still_bounds_[light]);
  }
}

bool ShadowCaster::all_have_bounds() const {
  return std::ranges::all_of(std::views::iota(0u, lights()), [this](std::uint32_t l) { return has_bounds(l); });
}

// Calls visit(tile) for squares whose points a caster within the hull may block. Trees have a few boxes more than there
// are squares.
template <typename Visit>
void ShadowCaster::visit_shaded(std::uint32_t light, const Hull& hull, std::vector<TileBounds>& faces,
                                const Visit& visit) {
  const LightViews& all = lights_[light];
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const GridBox box = box_of_hull(has_size(light) ? all.middle : all.views[f], hull);
    for (const std::uint32_t found : faces[f].tree.find(kernels_, box, all.spread, found_))
      if (found < faces[f].tiles.size()) visit(faces[f].tiles[found]);
  }
}

void ShadowCaster::mark_shaded(const geometry::Sweep& sweep, const Layer& still, raster::StillMarks& marks) {
  if (sweep.casters().empty()) return;
  if (!all_have_bounds()) return marks.mark_all();
  std::vector<std::uint32_t> tiles = still.tiles;
  for (std::uint32_t light = 0; light < lights(); ++light) {
    std::erase_if(tiles, [&](std::uint32_t tile) {
      const std::uint32_t top = tile / still.tiles_across() * kTile;
      return top >= sweep.lines().last || top + kTile <= sweep.lines().first || marks.has(tile);
    });
    bounds_.clear();
    bound(light, still, tiles, bounds_);
    for (const geometry::SweptHull& caster : sweep.casters())
      visit_shaded(light, hull_of(caster), bounds_, [&](std::uint32_t tile) { marks.mark_tile(tile); });
    look_();
  }
}

void ShadowCaster::find_shaded(const geometry::Scene& scene, std::vector<std::uint32_t>& tiles) {
  if (!all_have_bounds()) return;
  is_shaded_.assign(tiles.empty() ? 0 : *std::ranges::max_element(tiles) + 1, std::uint8_t{0});
  casters_.visit_hulls(scene, Casting::moving, [&](const Hull& hull) {
    for (std::uint32_t light = 0; light < lights(); ++light)
      visit_shaded(light, hull, still_bounds_[light], [&](std::uint32_t tile) {
        if (tile < is_shaded_.size()) is_shaded_[tile] = 1;
      });
  });
  std::erase_if(tiles, [this](std::uint32_t tile) { return is_shaded_[tile] == 0; });
}

}  // namespace mars::shadow
