#include "node/raster/scanline.h"

#include <algorithm>

#include "hal/failure/failure.h"
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
  const bool moves = any_boxes(parts, &LineBoxes::moving, line);
  if (several()) shade_groups(shading, line, extent);
  const StillGroups groups = keep(line, still);
  if (several()) {
    if (groups.end != still_end_.data())
      groups_.copy_to(groups, still.columns(line));
    else if (moves)
      groups_.copy_to(groups);
    groups_.resolve(shading, line, out.constant());
    z_line_.forget_ids(extent);
  } else {
    put_samples(shading, line, extent, out.constant());
  }
  z_line_.forget_depths(moves ? both(extent, draw_moving(parts, shading, line, groups, out)) : extent);
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
    draw_moving(parts, shading, line, kept && several() ? still.groups(line) : own_still(), out);
    z_line_.forget_depths(extent);
  }
}

shading::Extent ZBuffer::draw_still_again(LineParts parts, const shading::Shading& shading, std::uint32_t line) {
  const shading::Extent extent = z_line_.draw(parts, &LineBoxes::stationary, shading.triangles, line);
  shade_groups(shading, line, extent);
  groups_.copy_to(own_still());
  z_line_.forget_ids(extent);
  return extent;
}

shading::Extent ZBuffer::draw_moving(LineParts parts, const shading::Shading& shading, std::uint32_t line,
                                     const StillGroups& still, StripBuffer& out) {
  const shading::Extent extent = z_line_.draw(parts, &LineBoxes::moving, shading.triangles, line);
  if (several()) {
    shade_groups(shading, line, extent);
    groups_.resolve_over(still, shading, line, out.moving());
    z_line_.forget_ids(extent);
  } else {
    put_samples(shading, line, extent, out.moving());
  }
  return extent;
}

StillGroups ZBuffer::keep(std::uint32_t line, StillLines& still) {
  if (!still.lines().has(line)) return own_still();
  const std::uint32_t groups = several() ? groups_.count_on(still.marks().on(line)) : 0;
  if (!still.begin_line(line, groups)) return own_still();
  std::uint32_t columns = 0;
  for (std::uint32_t s = 0; s < samples_a_pixel(); ++s) columns = still.keep_depths(line, s, z_line_.depth(s));
  counts_.still_bytes += still.kept_bytes(columns, groups);
  return several() ? still.groups(line) : own_still();
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
                          StripBuffer::Layer& out) {
  if (is_empty(extent)) return;
  const auto shaded = shading_kernels_.shade(shading, z_line_.ids(0), line, extent, out.next_run(), out.next_pixel());
  counts_.shaded += shaded.counts;
  if (shading.encoding.alpha) put_opaque(shading.encoding, shaded.pixels, out.next_pixel());
  out.added(shaded);
  z_line_.forget_ids(extent);
}

}  // namespace mars::raster
