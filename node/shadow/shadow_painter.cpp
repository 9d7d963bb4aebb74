#include "node/shadow/shadow_painter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <numeric>
#include <span>

#include "hal/failure/failure.h"
#include "node/geometry/surface_view.h"
#include "node/shading/finish_light.h"
#include "node/simd/vector_slack.h"

namespace mars::shadow {
namespace {

constexpr std::size_t kGrain = 64;  // of the arena

bool receives(const wire::Material& material) {
  return material.receives == 1 && material.interpolation == wire::Interpolation::phong;
}

// Whether still parts show motion that they have in this frame alone.
bool shows_still_motion(const Picture& picture) {
  return picture.is_keyframe && picture.shading.surfaces != nullptr && picture.shading.surfaces->still_has_moved();
}

bool has_unshadowed(const Picture& picture) {
  return picture.shading.surfaces != nullptr && wire::has_layer(picture.shading.pixels, wire::Layer::unshadowed);
}

}  // namespace

ShadowPainter::ShadowPainter(simd::InstructionSet set, const geometry::Scene& scene, const ShadowPlan& plan,
                             bool has_layers)
    : raster_kernels_(raster::raster_kernels(set)),
      shading_kernels_(shading::shading_kernels(set)),
      width_(static_cast<std::uint32_t>(scene.width())),
      samples_(static_cast<std::uint32_t>(scene.pattern().count)),
      casting_(scene.casting_count()),
      z_line_(set, width_, scene.pattern(), scene.projection().nothing),
      groups_(set, width_, samples_),
      caster_(set, scene, plan),
      bytes_of_line_(band_bytes_of_line(shadow_needs(scene.film(), has_layers))),
      most_squares_(squares_of_points(shadow_needs(scene.film()), plan.points)),
      memory_(plan.band),
      arena_(memory_.bytes()),
      shares_(casting_, std::vector<float>(std::size_t{width_} * samples_ + simd::kVectorSlack)),
      still_groups_(std::size_t{width_} * samples_),
      no_ends_(width_),
      row_tiles_(wire::still_tile_words(width_)) {
  for (const auto& shares : shares_) share_rows_.push_back(shares.data());
  memory_.prefer_large_pages();
}

void ShadowPainter::begin(const Picture& picture, const std::function<void()>& look) {
  caster_.begin(picture.scene, look);
}

geometry::LineRange ShadowPainter::see(const Picture& picture, const geometry::LineRange& lines) {
  arena_.clear();
  range_ = lines;
  const std::size_t moved_bytes = width_ * casting_ * sizeof(std::uint16_t) + kGrain;
  std::size_t to_come = 0;  // of still lines, for what movers block (cast)
  for (Layer* layer : {&drawn_, &kept_, &moving_}) layer->begin(width_, range_);
  lines_.assign(range_.count(), {});
  for (std::uint32_t number = range_.first; number < range_.last; ++number) {
    if (arena_.rest().size() < bytes_of_line_ + to_come) {
      range_.last = number;
      break;
    }
    if (picture.is_keyframe)
      see_keyframe(picture, number);
    else
      see_inbetween(picture, number);
    if (kept_.line(number).depth != nullptr) to_come += moved_bytes;
  }
  drawn_.range = kept_.range = moving_.range = range_;
  drawn_.count_all_tiles();
  moving_.count_all_tiles();
  if (picture.is_keyframe && picture.still.lines().count() > 0) keep_groups(picture);
  return range_;
}

void ShadowPainter::see_keyframe(const Picture& picture, std::uint32_t number) {
  if (!raster::any_boxes(picture.parts, &raster::LineBoxes::of, number) && !picture.still.lines().has(number)) return;
  ++counts_.lines;
  const shading::Extent still = see_still(picture, number);
  z_line_.forget_depths(raster::both(still, see_moving(picture, number)));
}

void ShadowPainter::see_inbetween(const Picture& picture, std::uint32_t number) {
  const shading::Extent moving = raster::moving_extent(picture.parts, number);
  shading::Extent still = raster::kNothing;
  if (picture.still.keeps(number)) {
    see_kept(picture, number);
    if (raster::is_empty(moving)) return;
    for (std::uint32_t s = 0; s < samples_; ++s)
      picture.still.take_depths(number, s, {moving.first, moving.last}, z_line_.depth(s));
    counts_.still_bytes += std::uint64_t{moving.last - moving.first} * samples_ * sizeof(float);
  } else if (picture.still.has_memory_for(number)) {
    still = see_still(picture, number);
    ++counts_.drawn_again;
  } else {
    check(raster::is_empty(moving), "moving parts stay on the lines that were given memory");
  }
  ++counts_.lines;
  z_line_.forget_depths(raster::both(still, raster::both(moving, see_moving(picture, number))));
}

// Where moving parts may be in the picture, still groups are recorded: here, unless they surely go to where inbetweens
// look for them.
shading::Extent ShadowPainter::see_still(const Picture& picture, std::uint32_t number) {
  const shading::Extent extent =
      z_line_.draw(picture.parts, &raster::LineBoxes::stationary, picture.shading.triangles, number);
  Line& line = lines_[number - range_.first];
  LayerLine& layer = drawn_.line(number);
  line.still = shade(picture, number, extent);
  const std::uint32_t count = line.still.count();
  float* const depths = arena_.take<float>(std::size_t{width_} * samples_).data();
  layer.depth = depths;
  layer.stride = width_;
  layer.pairs = arena_.take<wire::StillPairs>(std::size_t{width_} * casting_).data();
  copy_depths(depths, {0, width_});
  std::fill_n(layer.pairs, std::size_t{width_} * casting_, wire::StillPairs{0, 0});
  find_lit(picture, line.still, layer.pairs);
  line.again.end = no_ends_.data();
  const bool again = shows_still_motion(picture);
  if (picture.scene.any_moves() || again) {
    layer.moved = new_moved();
    if (!picture.is_keyframe || again || !picture.still.has_room(number, count)) {
      line.again = new_record(picture, count);
      fill_record(picture, number, line.still, line.again, [](std::uint32_t) { return true; });
    }
  }
  line.still.from = line.still_from = &layer;
  z_line_.forget_ids(extent);
  return extent;
}

raster::UnsummedStill ShadowPainter::new_record(const Picture& picture, std::uint32_t groups) {
  const std::size_t bytes = wire::still_group_bytes(casting_);
  const bool has_layers = picture.shading.surfaces != nullptr;
  return {arena_.take<std::uint32_t>(width_).data(), nullptr, arena_.take<std::byte>(groups * bytes).data(), bytes,
          has_layers ? arena_.take<wire::SurfacePoint>(groups).data() : nullptr};
}

// What inbetweens need of the band, but for pairs, which casters are still to block.
void ShadowPainter::keep_groups(const Picture& picture) {
  raster::StillLines& still = picture.still;
  caster_.mark_shaded(picture.sweep, drawn_, still.marks());
  for (std::uint32_t number = range_.first; number < range_.last; ++number) {
    Line& line = lines_[number - range_.first];
    if (!still.lines().has(number)) continue;
    const raster::MarkedTiles marked = still.marks().on(number);
    const auto has = [&](std::uint32_t column) { return raster::has_column(marked, column); };
    std::uint32_t count = 0;
    for (std::uint32_t k = 0; k < line.still.count(); ++k) count += has(line.still.groups.fragments[k].column) ? 1 : 0;
    line.is_kept = still.begin_line(number, count);
    if (!line.is_kept || !raster::any(marked)) continue;
    const raster::UnsummedStill kept = still.unsummed(number);
    if (line.again.end == no_ends_.data()) line.again = kept;
    fill_record(picture, number, line.still, kept, has);
    if (shows_still_motion(picture))
      for (std::uint32_t k = 0; k < count; ++k) std::ranges::fill(kept.surfaces[k].motion, 0.0f);
    std::uint32_t columns = 0;
    for (std::uint32_t s = 0; s < samples_; ++s)
      columns = still.keep_depths(number, s, drawn_.line(number).depth + std::size_t{s} * width_);
    counts_.still_bytes += still.kept_bytes(columns, count);
  }
}

void ShadowPainter::keep_pairs(raster::StillLines& still) {
  for (std::uint32_t number = range_.first; number < range_.last; ++number) {
    if (!lines_[number - range_.first].is_kept || !raster::any(still.columns(number))) continue;
    still.keep_pairs(number, drawn_.line(number).pairs);
  }
}

// A line without columns has nothing that may change.
void ShadowPainter::see_kept(const Picture& picture, std::uint32_t number) {
  Line& line = lines_[number - range_.first];
  line.again.end = no_ends_.data();
  if (!raster::any(picture.still.columns(number))) return;
  LayerLine& layer = kept_.line(number);
  line.again = picture.still.unsummed(number);
  layer.depth = picture.still.depth(number, 0).data();
  layer.stride = width_;
  layer.pairs = line.again.pairs;
  line.still_from = &layer;
}

// MZB starts as CZB. Of samples that show what stands still, the moving layer has no depth.
shading::Extent ShadowPainter::see_moving(const Picture& picture, std::uint32_t number) {
  if (!raster::any_boxes(picture.parts, &raster::LineBoxes::moving, number)) return raster::kNothing;
  const shading::Extent extent =
      z_line_.draw(picture.parts, &raster::LineBoxes::moving, picture.shading.triangles, number);
  Line& line = lines_[number - range_.first];
  LayerLine& layer = moving_.line(number);
  line.moving = shade(picture, number, extent);
  float* const depths = arena_.take<float>(std::size_t{width_} * samples_).data();
  layer.depth = depths;
  layer.stride = width_;
  copy_depths(depths, extent);
  for (std::uint32_t s = 0; s < samples_; ++s)
    for (std::uint32_t x = extent.first; x < extent.last; ++x)
      if (z_line_.ids(s)[x] == shading::kNoTriangle) depths[s * width_ + x] = z_line_.nothing();
  layer.pairs = arena_.take<wire::StillPairs>(std::size_t{width_} * casting_).data();
  std::fill_n(layer.pairs, std::size_t{width_} * casting_, wire::StillPairs{0, 0});
  find_lit(picture, line.moving, layer.pairs);
  layer.moved = new_moved();
  line.moving.from = &layer;
  z_line_.forget_ids(extent);
  return extent;
}

std::uint16_t* ShadowPainter::new_moved() {
  const auto moved = arena_.take<std::uint16_t>(std::size_t{width_} * casting_);
  std::ranges::fill(moved, std::uint16_t{0});
  return moved.data();
}

ShadowPainter::LineGroups ShadowPainter::shade(const Picture& picture, std::uint32_t number,
                                               const shading::Extent& extent) {
  LineGroups out;
  if (raster::is_empty(extent)) return out;
  groups_.group(picture.shading, z_line_.samples(), extent);
  out.counts = groups_.counts();
  const std::size_t room = out.count() + simd::kVectorSlack;
  out.groups = {arena_.take<shading::Fragment>(room).data(), arena_.take<std::uint32_t>(room).data(),
                arena_.take<std::uint32_t>(room).data()};
  groups_.copy_to(out.groups);
  const auto channel = [&] { return arena_.take<float>(room).data(); };
  const auto terms = arena_.take<float*>(std::size_t{3} * casting_);
  for (float*& term : terms) term = channel();
  const bool foggy = picture.shading.fog.end > picture.shading.fog.start;
  out.light = {{channel(), channel(), channel()}, foggy ? channel() : nullptr, terms.data()};
  counts_.shaded +=
      shading_kernels_.shade_unsummed(picture.shading, out.groups.fragments, out.count(), number, out.light);
  return out;
}

void ShadowPainter::copy_depths(float* to, const shading::Extent& extent) {
  for (std::uint32_t s = 0; s < samples_; ++s) {
    float* const row = to + std::size_t{s} * width_;
    std::fill_n(row, extent.first, z_line_.nothing());
    std::copy_n(z_line_.depth(s) + extent.first, extent.last - extent.first, row + extent.first);
    std::fill(row + extent.last, row + width_, z_line_.nothing());
  }
}

// Pairs matter where the light would add something if all of it arrived.
void ShadowPainter::find_lit(const Picture& picture, const LineGroups& groups, wire::StillPairs* pairs) const {
  for (std::uint32_t k = 0; k < groups.count(); ++k) {
    const shading::Fragment& fragment = groups.groups.fragments[k];
    if (!receives(picture.shading.materials[picture.shading.triangles[fragment.triangle].material])) continue;
    for (std::uint32_t light = 0; light < casting_; ++light) {
      float* const* const terms = groups.light.terms + 3 * light;
      if (!(terms[0][k] > 0 || terms[1][k] > 0 || terms[2][k] > 0)) continue;
      std::uint16_t& lit = pairs[std::size_t{light} * width_ + fragment.column].lit;
      lit = static_cast<std::uint16_t>(lit | pairs_of(groups.groups.masks[k], caster_.pairs_a_sample(light)));
    }
  }
}

// As raster::PixelGroups::copy_to does, of the columns that `has` says.
template <typename Has>
void ShadowPainter::fill_record(const Picture& picture, std::uint32_t number, const LineGroups& groups,
                                const raster::UnsummedStill& to, const Has& has) const {
  const shading::Fragment* const fragments = groups.groups.fragments;
  std::fill_n(to.end, width_, 0u);
  for (std::uint32_t k = 0; k < groups.count(); ++k) to.end[fragments[k].column] += has(fragments[k].column) ? 1 : 0;
  std::exclusive_scan(to.end, to.end + width_, to.end, 0u);
  const bool foggy = groups.light.fog != nullptr;
  for (std::uint32_t k = 0; k < groups.count(); ++k) {
    if (!has(fragments[k].column)) continue;
    const std::uint32_t at = to.end[fragments[k].column]++;
    wire::UnsummedGroup& group = to.group(at);
    if (to.surfaces != nullptr) to.surfaces[at] = raster::point_of(picture.shading, fragments[k], number);
    group.samples = groups.groups.masks[k];
    group.fog = foggy ? groups.light.fog[k] : 0;
    for (std::size_t c = 0; c < 3; ++c) group.base[c] = groups.light.base[c][k];
    for (std::size_t t = 0; t < std::size_t{3} * casting_; ++t) group.terms()[t] = groups.light.terms[t][k];
  }
}

void ShadowPainter::cast(const Picture& picture) {
  if (!picture.is_keyframe && picture.scene.any_moves()) {
    count_kept_tiles(picture.still);
    if (!caster_.knows_still(range_)) caster_.bound_still(kept_);
    caster_.find_shaded(picture.scene, kept_.tiles);
    for (const std::uint32_t tile : kept_.tiles) {
      const std::uint32_t first = tile / kept_.tiles_across() * kTile;
      for (std::uint32_t number = first; number < first + kTile; ++number)
        if (kept_.range.has(number) && kept_.line(number).depth != nullptr && kept_.line(number).moved == nullptr)
          kept_.line(number).moved = new_moved();
    }
  }
  cast_by_rows(picture.scene);
  if (picture.is_keyframe) keep_pairs(picture.still);
}

// On squares of as many rows at a time as there is memory for points of.
void ShadowPainter::cast_by_rows(const geometry::Scene& scene) {
  const std::array<Layer*, 3> layers{&drawn_, &moving_, &kept_};
  for (std::size_t k = 0; k < layers.size(); ++k) std::swap(layers[k]->tiles, tiles_[k]);
  std::array<std::size_t, 3> done{};
  const auto rest_up_to = [&](std::size_t k, std::uint32_t row) {
    const auto rest = std::span(std::as_const(tiles_[k])).subspan(done[k]);
    return rest.first(
        static_cast<std::size_t>(std::ranges::lower_bound(rest, row * drawn_.tiles_across()) - rest.begin()));
  };
  for (std::uint32_t row = range_.first / kTile, end = row; row * kTile < range_.last; row = end) {
    const auto count_up_to = [&](std::uint32_t to) {
      return rest_up_to(0, to).size() + rest_up_to(1, to).size() + rest_up_to(2, to).size();
    };
    do {
      ++end;
    } while (end * kTile < range_.last && count_up_to(end + 1) <= most_squares_);
    if (count_up_to(end) == 0) continue;
    for (std::size_t k = 0; k < layers.size(); ++k) {
      const auto some = rest_up_to(k, end);
      layers[k]->tiles.assign(some.begin(), some.end());
      done[k] += some.size();
    }
    caster_.cast(scene, std::span(layers).first(2), kept_);
  }
}

void ShadowPainter::count_kept_tiles(const raster::StillLines& still) {
  kept_.tiles.clear();
  for (std::uint32_t row = range_.first / kTile; row * kTile < range_.last; ++row) {
    std::ranges::fill(row_tiles_, std::uint64_t{0});
    for (std::uint32_t number = row * kTile; number < (row + 1) * kTile; ++number)
      if (range_.has(number) && kept_.line(number).depth != nullptr)
        std::ranges::transform(row_tiles_, still.columns(number), row_tiles_.begin(), std::bit_or<>());
    raster::visit_columns(row_tiles_, width_, [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t x = first; x < last; x += kTile) kept_.tiles.push_back(row * kept_.tiles_across() + x / kTile);
    });
  }
}

void ShadowPainter::put_line(const Picture& picture, std::uint32_t number, raster::StripBuffer& out) {
  Line& line = lines_[number - range_.first];
  if (picture.is_keyframe && line.still.count() > 0) {
    sum_up(picture, line.still, false);
    groups_.resolve(picture.shading, number, out.constant());
  }
  find_changed(picture, line);
  if (line.moving.count() == 0 && changed_.empty()) return;
  const std::uint32_t all = (1u << samples_) - 1;
  for (const std::uint32_t column : changed_) sum_up_again(picture, line, column);
  for (std::uint32_t k = 0; k < line.moving.counts.pixels; ++k)
    if (line.moving.groups.masks[k] != all) sum_up_again(picture, line, line.moving.groups.fragments[k].column);
  sum_up(picture, line.moving, true);
  groups_.resolve_over({line.again.end, still_groups_.data(), line.again.surfaces, unshadowed_groups_.data()},
                       picture.shading, number, out.moving(), changed_);
}

float ShadowPainter::open_share(const LayerLine& from, std::uint32_t light, std::uint32_t column, std::uint32_t samples,
                                bool with_moved) const {
  const std::size_t at = std::size_t{light} * width_ + column;
  const std::uint32_t moved = with_moved && from.moved != nullptr ? from.moved[at] : 0u;
  const std::uint32_t blocked = from.pairs[at].blocked | moved;
  if (blocked == 0) return 1;
  const std::uint32_t all = pairs_of(samples, caster_.pairs_a_sample(light));
  return static_cast<float>(std::popcount(all & ~blocked)) / static_cast<float>(std::popcount(all));
}

// To the groups that are resolved next.
void ShadowPainter::sum_up(const Picture& picture, const LineGroups& groups, bool with_moved) {
  groups_.restore(groups.counts, groups.groups);
  if (has_unshadowed(picture)) sum_up_unshadowed(picture, groups);
  if (groups.count() == 0) return;
  for (std::uint32_t light = 0; light < casting_; ++light)
    for (std::uint32_t k = 0; k < groups.count(); ++k)
      shares_[light][k] =
          open_share(*groups.from, light, groups.groups.fragments[k].column, groups.groups.masks[k], with_moved);
  shading_kernels_.sum_up(picture.shading, groups.light, share_rows_.data(), groups.count(), groups_.light().channel);
}

void ShadowPainter::sum_up_unshadowed(const Picture& picture, const LineGroups& groups) {
  const raster::Light light = groups_.unshadowed();
  for (auto& shares : shares_) std::fill_n(shares.begin(), groups.count(), 1.0f);
  if (groups.count() > 0)
    shading_kernels_.sum_up(picture.shading, groups.light, share_rows_.data(), groups.count(), light.channel);
}

// Still pixels that moving casters take light from, or that show motion in this frame.
void ShadowPainter::find_changed(const Picture& picture, const Line& line) {
  changed_.clear();
  if (shows_still_motion(picture) && line.still_from != nullptr) {
    for (std::uint32_t column = 0; column < width_; ++column)
      if (line.again.end[column] > (column == 0 ? 0 : line.again.end[column - 1])) changed_.push_back(column);
    return;
  }
  if (line.still_from == nullptr || !line.still_from->is_changed) return;
  for (std::uint32_t column = 0; column < width_; ++column) {
    std::uint32_t moved = 0;
    for (std::uint32_t light = 0; light < casting_; ++light)
      moved |= line.still_from->moved[std::size_t{light} * width_ + column];
    if (moved != 0) changed_.push_back(column);
  }
}

void ShadowPainter::sum_up_again(const Picture& picture, const Line& line, std::uint32_t column) {
  if (line.still_from == nullptr) return;
  put_still_light(picture, line, column, true);
  if (!has_unshadowed(picture)) return;
  unshadowed_groups_.resize(still_groups_.size());
  put_still_light(picture, line, column, false);
}

// As the kernels do (shading::ShadingKernels::sum_up), for one pixel's still groups.
void ShadowPainter::put_still_light(const Picture& picture, const Line& line, std::uint32_t column, bool shadowed) {
  const raster::UnsummedStill& from = line.again;
  for (std::uint32_t k = column == 0 ? 0 : from.end[column - 1]; k < from.end[column]; ++k) {
    const wire::UnsummedGroup& group = from.group(k);
    wire::StillGroup& out = shadowed ? still_groups_[k] : unshadowed_groups_[k];
    out.samples = group.samples;
    std::copy_n(group.base, 3, out.light);
    for (std::uint32_t light = 0; light < casting_; ++light) {
      const float share = shadowed ? open_share(*line.still_from, light, column, group.samples, true) : 1;
      for (std::size_t c = 0; c < 3; ++c) out.light[c] += group.terms()[3 * light + c] * share;
    }
    shading::finish_light(picture.shading, group.fog, out.light);
  }
}

}  // namespace mars::shadow
