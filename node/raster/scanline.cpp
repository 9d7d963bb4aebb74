#include "node/raster/scanline.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "node/geometry/surface_view.h"
#include "node/raster/coverage.h"

namespace mars::raster {

ZBuffer::ZBuffer(simd::InstructionSet set, std::uint32_t width, const shape::SamplePattern& pattern, float nothing)
    : shading_kernels_(shading::shading_kernels(set)),
      z_line_(set, width, pattern, nothing),
      groups_(set, several() ? width : 0, samples_a_pixel()),
      still_end_(several() ? width : 0),
      still_groups_(still_end_.size() * samples_a_pixel()) {}

void ZBuffer::draw_keyframe(LineParts parts, const geometry::LineRange& lines, const shading::Shading& shading,
                            StillLines& still, StripBuffer& out) {
  for (std::uint32_t line = lines.first; line < lines.last; ++line)
    if (any_boxes(parts, &LineBoxes::of, line) || still.lines().has(line)) draw_line(parts, shading, line, still, out);
}

// MZB starts as CZB: nearer than it is nearer than both, and of equals what stands still was there first.
void ZBuffer::draw_line(LineParts parts, const shading::Shading& shading, std::uint32_t line, StillLines& still,
                        StripBuffer& out) {
  ++counts_.lines;
  const shading::Extent extent = z_line_.draw(parts, &LineBoxes::stationary, shading.triangles, line);
  // In this frame alone: inbetweens show it as it stands still.
  const bool has_moved = shading.surfaces != nullptr && shading.surfaces->still_has_moved();
  const bool moves = has_moved || any_boxes(parts, &LineBoxes::moving, line);
  if (several()) shade_groups(shading, line, extent);
  StillGroups groups = keep(line, still, shading);
  if (several()) {
    groups = copy_still(line, still, groups, shading, moves);
    groups_.resolve(shading, line, out.constant());
    z_line_.forget_ids(extent);
  } else {
    if (has_moved) keep_ids(extent);
    put_samples(shading, line, extent, out.constant(), false);
  }
  const shading::Extent again = has_moved ? extent : kNothing;
  z_line_.forget_depths(moves ? both(extent, draw_moving(parts, shading, line, groups, again, out)) : extent);
}

StillGroups ZBuffer::copy_still(std::uint32_t line, StillLines& still, const StillGroups& kept,
                                const shading::Shading& shading, bool needed) {
  const bool has_moved = shading.surfaces != nullptr && shading.surfaces->still_has_moved();
  const StillGroups own = own_still(shading);
  const bool is_kept = kept.end != own.end;
  if (is_kept) groups_.copy_to(kept, shading, line, still.columns(line));
  if (is_kept && has_moved)
    for (std::uint32_t k = 0; k < kept.end[still_end_.size() - 1]; ++k)
      std::ranges::fill(kept.surfaces[k].motion, 0.0f);
  if (is_kept && !has_moved) return kept;
  if (needed) groups_.copy_to(own, shading, line);
  return own;
}

void ZBuffer::draw_inbetween(LineParts parts, const geometry::LineRange& lines, const shading::Shading& shading,
                             StillLines& still, StripBuffer& out) {
  for (std::uint32_t line = lines.first; line < lines.last; ++line) {
    shading::Extent extent = moving_extent(parts, line);
    if (is_empty(extent)) continue;
    check(still.has_memory_for(line), "moving parts stay on the lines that were given memory");
    const bool kept = still.keeps(line);
    ++counts_.lines;
    counts_.drawn_again += kept ? 0 : 1;
    if (kept)
      take_depths(line, extent, still);
    else
      extent = both(extent, draw_still_again(parts, shading, line));
    draw_moving(parts, shading, line, kept && several() ? still.groups(line) : own_still(shading), kNothing, out);
    z_line_.forget_depths(extent);
  }
}

shading::Extent ZBuffer::draw_still_again(LineParts parts, const shading::Shading& shading, std::uint32_t line) {
  const shading::Extent extent = z_line_.draw(parts, &LineBoxes::stationary, shading.triangles, line);
  shade_groups(shading, line, extent);
  groups_.copy_to(own_still(shading), shading, line);
  z_line_.forget_ids(extent);
  return extent;
}

shading::Extent ZBuffer::draw_moving(LineParts parts, const shading::Shading& shading, std::uint32_t line,
                                     const StillGroups& still, const shading::Extent& again, StripBuffer& out) {
  const shading::Extent extent = z_line_.draw(parts, &LineBoxes::moving, shading.triangles, line);
  if (several()) {
    shade_groups(shading, line, extent);
    again_.clear();
    for (std::uint32_t column = again.first; column < again.last; ++column)
      if (still.end[column] > still.begin(column)) again_.push_back(column);
    groups_.resolve_over(still, shading, line, out.moving(), again_);
    z_line_.forget_ids(extent);
  } else {
    show_kept_ids(again);
    put_samples(shading, line, both(extent, again), out.moving(), true);
  }
  return extent;
}

StillGroups ZBuffer::keep(std::uint32_t line, StillLines& still, const shading::Shading& shading) {
  const StillGroups own = own_still(shading);
  if (!still.lines().has(line)) return own;
  const std::uint32_t groups = several() ? groups_.count_on(still.marks().on(line)) : 0;
  if (!still.begin_line(line, groups)) return own;
  std::uint32_t columns = 0;
  for (std::uint32_t s = 0; s < samples_a_pixel(); ++s) columns = still.keep_depths(line, s, z_line_.depth(s));
  counts_.still_bytes += still.kept_bytes(columns, groups);
  return several() ? still.groups(line) : own;
}

StillGroups ZBuffer::own_still(const shading::Shading& shading) {
  if (shading.surfaces != nullptr) still_surfaces_.resize(still_groups_.size());
  return {still_end_.data(), still_groups_.data(), shading.surfaces != nullptr ? still_surfaces_.data() : nullptr};
}

void ZBuffer::take_depths(std::uint32_t line, const shading::Extent& extent, StillLines& still) {
  for (std::uint32_t s = 0; s < samples_a_pixel(); ++s)
    still.take_depths(line, s, {extent.first, extent.last}, z_line_.depth(s));
  counts_.still_bytes += std::uint64_t{extent.last - extent.first} * samples_a_pixel() * sizeof(float);
}

void ZBuffer::shade_groups(const shading::Shading& shading, std::uint32_t line, const shading::Extent& extent) {
  counts_.shaded += groups_.shade(shading, z_line_.samples(), line, extent);
}

// With one sample a pixel: shades what is seen, and forgets it.
void ZBuffer::put_samples(const shading::Shading& shading, std::uint32_t line, const shading::Extent& extent,
                          StripBuffer::Layer& out, bool with_motion) {
  if (is_empty(extent)) return;
  const bool has_layers = shading.surfaces != nullptr;
  if (has_layers) layers_.begin(shading.pixels, extent.last - extent.first);
  void* const pixels = has_layers ? layers_.colors() : out.next_pixel();
  const auto shaded = shading_kernels_.shade(shading, z_line_.ids(0), line, extent, out.next_run(), pixels);
  counts_.shaded += shaded.counts;
  if (shading.encoding.alpha) put_opaque(shading.encoding, shaded.pixels, pixels);
  if (has_layers) put_layers(shading, shaded, out, with_motion);
  out.added(shaded);
  z_line_.forget_ids(extent);
}

void ZBuffer::put_layers(const shading::Shading& shading, const shading::Shaded& shaded, StripBuffer::Layer& out,
                         bool with_motion) {
  std::uint32_t pixel = 0;
  for (const wire::Run& run : std::span(out.next_run(), shaded.runs))
    for (std::uint32_t column = run.first; column < std::uint32_t{run.first} + run.count; ++column) {
      const auto at = [](std::uint32_t k) { return static_cast<std::int32_t>(k) * shape::kSubpixels; };
      SurfacePoint point = shading.surfaces->at(shading.triangles[z_line_.ids(0)[column]],
                                                at(column) + shape::kSampleOffset, at(run.line) + shape::kSampleOffset);
      if (!with_motion) std::ranges::fill(point.motion, 0.0f);
      layers_.add(pixel++, 1, point);
    }
  layers_.write(shaded.pixels, false, out.next_pixel());
}

// Of what stands still, before what moves is drawn over it without them, as in inbetweens.
void ZBuffer::keep_ids(const shading::Extent& extent) {
  const auto* const ids = z_line_.ids(0);
  still_ids_.assign(ids, ids + (is_empty(extent) ? 0 : extent.last));
}

void ZBuffer::show_kept_ids(const shading::Extent& extent) {
  for (std::uint32_t column = extent.first; column < extent.last; ++column)
    if (z_line_.ids(0)[column] == shading::kNoTriangle) z_line_.ids(0)[column] = still_ids_[column];
}

}  // namespace mars::raster
