#include "node/shadow/shadow_caster.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <ranges>
#include <utility>

#include "node/shadow/block_plainly.h"
#include "node/simd/vector_slack.h"

namespace mars::shadow {
namespace {

Hull hull_of(const geometry::SweptHull& swept) {
  Hull hull;
  for (std::size_t axis = 0; axis < 3; ++axis) std::ranges::copy(swept.along[axis], hull.along[axis]);
  hull.count = swept.count;
  return hull;
}

}  // namespace

ShadowCaster::ShadowCaster(simd::InstructionSet set, const geometry::Scene& scene, const ShadowPlan& plan)
    : kernels_(shadow_kernels(set)),
      pattern_(scene.pattern()),
      samples_(static_cast<std::uint32_t>(pattern_.count)),
      hard_(pattern_, false),
      soft_(pattern_, true, scene.projection().origin[0], scene.projection().origin[1]),
      diced_(scene.film().patch_instances(), plan.diced),
      casters_(set, plan.chunk),
      points_bytes_(plan.points),
      grid_(kernels_),
      shafts_(kernels_) {}

void ShadowCaster::begin(const geometry::Scene& scene, const std::function<void()>& look) {
  look_ = look;
  const auto casting = scene.casting_lights();
  lights_.resize(casting.size());
  for (std::size_t k = 0; k < casting.size(); ++k)
    lights_[k] = light_views(casting[k], scene.projection(), std::move(lights_[k]));
}

void ShadowCaster::cast(const geometry::Scene& scene, Layers drawn, Layer& kept) {
  all_layers_.assign(drawn.begin(), drawn.end());
  all_layers_.push_back(&kept);
  for (std::uint32_t light = 0; light < lights(); ++light) {
    if (!has_size(light)) {
      cast_from_point(scene, light, drawn, kept);
      continue;
    }
    cast_from_all(scene, Casting::still, light, drawn);
    if (scene.any_moves()) cast_from_all(scene, Casting::moving, light, all_layers_);
  }
}

PointSource ShadowCaster::source_of(std::uint32_t light, std::uint32_t point) const {
  return {kernels_, lights_[light].frame, pattern_, vectors_of(light), light, has_size(light) ? point : 0};
}

// Of points of all samples, whatever the light's size.
PointSource ShadowCaster::samples_of(std::uint32_t light) const {
  return {kernels_, lights_[light].frame, pattern_, hard_, light, 0};
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
      const GridBox box = grid_.put(views[f], hull);
      for (Faces* faces : onto)
        if ((*faces)[f].tree().any(kernels_, box, 0)) return true;
    }
    return false;
  };
  casters_.begin(scene, casting, diced_);
  for (auto chunk = next_casters(std::cref(matters)); !chunk.empty(); chunk = next_casters(std::cref(matters)))
    for (Faces* faces : onto) block(chunk, views, *faces);
}

// Of a light that has a size: each chunk of casters is seen from each of its points, with the points that this one
// decides about.
void ShadowCaster::cast_from_all(const geometry::Scene& scene, Casting casting, std::uint32_t light, Layers onto) {
  const LightViews& all = lights_[light];
  shafts_.begin(all, samples_of(light), pairs_a_sample(light), onto);
  const auto matters = [&](const Hull& hull) { return shafts_.meet(hull, grid_); };
  casters_.begin(scene, casting, diced_);
  for (auto chunk = next_casters(std::cref(matters)); !chunk.empty(); chunk = next_casters(std::cref(matters))) {
    const Touched& some = shafts_.find(chunk, grid_);
    if (some.casters.empty()) continue;
    for (std::uint32_t point = 0; point < all.points; ++point) {
      const PointSource source = source_of(light, point);
      const auto views = views_of(light, point);
      begin_points(views, drawn_points_);
      for (std::size_t k = 0; k < onto.size(); ++k)
        for (const TilePart& part : some.parts[k]) add_points(source, views, *onto[k], part, drawn_points_);
      finish_points(drawn_points_);
      block(some.casters, views, drawn_points_);
      for (Points& points : drawn_points_) points.note(source, casting);
    }
  }
}

void ShadowCaster::put_points(const PointSource& source, std::span<const LightView> views, Layers onto, Faces& faces) {
  begin_points(views, faces);
  for (Layer* layer : onto)
    for (const std::uint32_t tile : layer->tiles) add_points(source, views, *layer, {tile, TilePart::kAll}, faces);
  finish_points(faces);
}

void ShadowCaster::begin_points(std::span<const LightView> views, Faces& faces) {
  if (faces.size() < views.size()) faces.resize(views.size());
  forget_points(faces);
}

void ShadowCaster::finish_points(Faces& faces) {
  for (Points& points : faces) {
    points.finish();
    counts_.points += points.count();
  }
  look_();
}

// Grids that had many points before keep no memory that others need.
void ShadowCaster::forget_points(Faces& faces) {
  std::size_t bytes = 0;
  const Faces* const kinds[] = {&drawn_points_, &kept_points_, &shafts_.points()};
  for (const Faces* all : kinds)
    for (const Points& points : *all) bytes += points.bytes();
  if (bytes > points_bytes_) std::ranges::fill(faces, Points());
  for (Points& points : faces) points.clear();
}

std::span<const ChunkCaster> ShadowCaster::next_casters(const CasterStream::Matters& matters) {
  const std::span<const ChunkCaster> chunk = casters_.next(matters);
  for (const ChunkCaster& caster : chunk) {
    if (!caster.is_new) continue;
    ++counts_.surfaces;
    counts_.diced_vertices += caster.surface->vertices;
  }
  return chunk;
}

void ShadowCaster::block(std::span<const ChunkCaster> casters, std::span<const LightView> views, Faces& faces) {
  for (std::size_t f = 0; f < views.size(); ++f) {
    if (faces[f].empty()) continue;
    for (const ChunkCaster& caster : casters) block(caster, views[f], faces[f]);
    look_();
  }
}

void ShadowCaster::block(const ChunkCaster& caster, const LightView& view, Points& points) {
  const std::span<const std::uint32_t> found = grid_.find_below(grid_.put(view, caster.hull), kRay, points);
  if (found.empty()) return;
  const Caster& surface = *caster.surface;
  counts_.vertices += surface.vertices;
  const GridBox box = grid_.put(view, surface);
  if (box.low_x > box.high_x) return;
  counts_.triangles += surface.triangles.count;
  GridBox where = kNowhere;
  for (const std::uint32_t vector : found) where = around(where, points.vectors()[vector].box);
  grid_.visit_batches(
      view, surface, where,
      [&](const SmallBatches& batches, std::uint32_t) {
        kernels_.block(batches, points.vectors(), found.data(), static_cast<std::uint32_t>(found.size()));
      },
      [&](std::uint32_t triangle, std::uint32_t) {
        for_each_piece(view, surface, grid_.vertices(), triangle, [&](const LargeTriangle& piece) {
          block_plainly(piece, points.vectors(), points.tree().find(kernels_, piece.box(), 0, found_));
        });
      });
}

void ShadowCaster::bound(std::uint32_t light, const Layer& layer, std::span<const std::uint32_t> tiles,
                         std::vector<TileBounds>& faces) const {
  const std::vector<LightView>& views = lights_[light].middle;
  if (faces.size() < views.size()) faces.resize(views.size());
  for (std::size_t f = 0; f < views.size(); ++f) {
    const LightView& view = views[f];
    TileBounds& face = faces[f];
    face.tree.clear();
    face.tiles.clear();
    float high_z = 0;
    for (const std::uint32_t tile : tiles) {
      const GridBox box = bound_tile(light, view, layer, tile);
      if (box.low_x > box.high_x) continue;
      high_z = std::max(high_z, box.high_z);
      face.tree.add(box);
      face.tiles.push_back(tile);
    }
    face.tree.finish();
    face.reach = reach_of(lights_[light], high_z);
  }
}

GridBox ShadowCaster::bound_tile(std::uint32_t light, const LightView& view, const Layer& layer,
                                 std::uint32_t tile) const {
  const std::uint32_t n = pairs_a_sample(light), some = (1u << n) - 1;
  GridBox box = kNowhere;
  const auto counts = [n, some](const wire::StillPairs& pairs, const Lane& lane, std::uint16_t) {
    return (pairs.lit >> (lane.sample * n) & some) != 0;
  };
  for_each_vector(samples_of(light), layer, tile, counts, std::span(&view, 1),
                  [&](const PointVector& points, std::uint32_t, std::size_t) { box = around(box, points.box); });
  return box;
}

void ShadowCaster::forget_still() {
  knows_still_ = false;
  diced_.clear(Casting::still);
}

void ShadowCaster::bound_still(const Layer& still) {
  still_lines_ = still.range;
  still_bounds_.resize(lights());
  for (std::uint32_t light = 0; light < lights(); ++light) bound(light, still, still.tiles, still_bounds_[light]);
  knows_still_ = true;
}

// Calls visit(tile) for squares whose points a caster within the hull may block; all where that is not known. Trees
// have a few boxes more than there are squares.
template <typename Visit>
void ShadowCaster::visit_shaded(std::uint32_t light, const Hull& hull, std::vector<TileBounds>& faces,
                                const Visit& visit) {
  const LightViews& all = lights_[light];
  for (std::size_t f = 0; f < std::min(faces.size(), all.middle.size()); ++f) {
    if (is_near(all, f, faces[f].reach, hull)) {
      std::ranges::for_each(faces[f].tiles, visit);
      continue;
    }
    for (const std::uint32_t found :
         faces[f].tree.find(kernels_, grid_.put(all.middle[f], hull), faces[f].reach.shaft.spread, found_))
      if (found < faces[f].tiles.size()) visit(faces[f].tiles[found]);
  }
}

void ShadowCaster::mark_shaded(const geometry::Sweep& sweep, const Layer& still, raster::StillMarks& marks) {
  if (sweep.casters().empty()) return;
  marked_tiles_ = still.tiles;
  for (std::uint32_t light = 0; light < lights(); ++light) {
    std::erase_if(marked_tiles_, [&](std::uint32_t tile) {
      const std::uint32_t top = tile / still.tiles_across() * kTile;
      return top >= sweep.lines().last || top + kTile <= sweep.lines().first || marks.has(tile);
    });
    bound(light, still, marked_tiles_, bounds_);
    for (const geometry::SweptHull& caster : sweep.casters())
      visit_shaded(light, hull_of(caster), bounds_, [&](std::uint32_t tile) { marks.mark_tile(tile); });
    look_();
  }
}

void ShadowCaster::find_shaded(const geometry::Scene& scene, std::vector<std::uint32_t>& tiles) {
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
