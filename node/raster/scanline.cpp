#include "node/raster/scanline.h"

#include <algorithm>

#include "hal/failure/failure.h"

namespace mars::raster {
namespace {

constexpr shading::Extent kNothing{0xffffffffu, 0};

bool is_empty(const shading::Extent& extent) { return extent.first >= extent.last; }

shading::Extent both(const shading::Extent& a, const shading::Extent& b) {
  return {std::min(a.first, b.first), std::max(a.last, b.last)};
}

// Rows of samples begin on cache lines and end with kVectorSlack to spare.
std::uint32_t stride_of(std::uint32_t width) {
  constexpr auto kSlack = static_cast<std::uint32_t>(simd::kVectorSlack);
  return (width - 1) / kSlack * kSlack + 2 * kSlack;
}

bool any_boxes(LineParts parts, std::span<const EdgeBox> (LineBoxes::*kind)(std::uint32_t line) const,
               std::uint32_t line) {
  return std::ranges::any_of(parts, [=](const LineBoxes& part) { return !(part.*kind)(line).empty(); });
}

shading::Extent moving_extent(LineParts parts, std::uint32_t line) {
  shading::Extent extent = kNothing;
  for (const LineBoxes& part : parts)
    for (const EdgeBox& box : part.moving(line)) extent = both(extent, {box.first, box.last()});
  return extent;
}

// The triangles of the first boxes, which the kernel has no time to fetch ahead.
void fetch(const geometry::Triangle* triangles, std::span<const EdgeBox> boxes) {
  constexpr std::size_t kFirst = 32;
  for (const EdgeBox& box : boxes.first(std::min(boxes.size(), kFirst))) __builtin_prefetch(triangles + box.triangle);
}

}  // namespace

ZBuffer::ZBuffer(simd::InstructionSet set, std::uint32_t width, const shape::SamplePattern& pattern)
    : kernels_(raster_kernels(set)),
      shading_kernels_(shading::shading_kernels(set)),
      pattern_(pattern),
      stride_(stride_of(width)),
      depths_(static_cast<std::size_t>(pattern.count) * stride_ / simd::kVectorSlack),
      ids_(depths_.size()),
      groups_(set, several() ? width : 0, static_cast<std::uint32_t>(pattern.count)),
      still_end_(several() ? width : 0),
      still_groups_(still_end_.size() * static_cast<std::size_t>(pattern.count)) {
  std::fill_n(ids(0), ids_.size() * simd::kVectorSlack, shading::kNoTriangle);
}

void ZBuffer::draw_keyframe(LineParts parts, const geometry::LineRange& lines, const shading::Shading& shading,
                            StillLines& still, StripBuffer& out) {
  for (std::uint32_t line = lines.first; line < lines.last; ++line)
    if (any_boxes(parts, &LineBoxes::of, line) || still.lines().has(line)) draw_line(parts, shading, line, still, out);
}

// MZB starts as CZB: nearer than it is nearer than both, and of equals what stands still was there first.
void ZBuffer::draw_line(LineParts parts, const shading::Shading& shading, std::uint32_t line, StillLines& still,
                        StripBuffer& out) {
  ++counts_.lines;
  const shading::Extent extent = draw(parts, &LineBoxes::stationary, shading, line);
  const bool moves = any_boxes(parts, &LineBoxes::moving, line);
  if (several()) shade_groups(shading, line, extent);
  const StillGroups groups = keep(line, still);
  if (several()) {
    if (moves || still.lines().has(line)) groups_.copy_to(groups);
    groups_.resolve(shading, line, out.constant());
    forget_ids(extent);
  } else {
    put_samples(shading, line, extent, out.constant());
  }
  forget_depths(moves ? both(extent, draw_moving(parts, shading, line, groups, out)) : extent);
}

std::uint32_t ZBuffer::draw_inbetween(LineParts parts, const geometry::LineRange& lines,
                                      const shading::Shading& shading, StillLines& still, StripBuffer& out) {
  std::uint32_t drawn_again = 0;
  for (std::uint32_t line = lines.first; line < lines.last; ++line) {
    shading::Extent extent = moving_extent(parts, line);
    if (is_empty(extent)) continue;
    check(still.has_memory_for(line), "moving parts stay on the lines that were given memory");
    const bool kept = still.keeps(line);
    ++counts_.lines;
    drawn_again += kept ? 0 : 1;
    if (kept)
      take_depths(line, extent, still);
    else
      extent = both(extent, draw_still_again(parts, shading, line));
    draw_moving(parts, shading, line, kept && several() ? still.groups(line) : own_still(), out);
    forget_depths(extent);
  }
  return drawn_again;
}

shading::Extent ZBuffer::draw_still_again(LineParts parts, const shading::Shading& shading, std::uint32_t line) {
  const shading::Extent extent = draw(parts, &LineBoxes::stationary, shading, line);
  shade_groups(shading, line, extent);
  groups_.copy_to(own_still());
  forget_ids(extent);
  return extent;
}

shading::Extent ZBuffer::draw_moving(LineParts parts, const shading::Shading& shading, std::uint32_t line,
                                     const StillGroups& still, StripBuffer& out) {
  const shading::Extent extent = draw(parts, &LineBoxes::moving, shading, line);
  if (several()) {
    shade_groups(shading, line, extent);
    groups_.resolve_over(still, shading, line, out.moving());
    forget_ids(extent);
  } else {
    put_samples(shading, line, extent, out.moving());
  }
  return extent;
}

shading::Extent ZBuffer::draw(LineParts parts, BoxesOf kind, const shading::Shading& shading, std::uint32_t line) {
  shading::Extent all = kNothing;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto boxes = (parts[p].*kind)(line);
    if (p + 1 < parts.size())
      fetch(shading.triangles, (parts[p + 1].*kind)(line));
    else if (line + 1 < parts[0].lines.last)
      fetch(shading.triangles, (parts[0].*kind)(line + 1));
    if (boxes.empty()) continue;
    all = both(all, kernels_.draw(shading.triangles, boxes.data(), static_cast<std::uint32_t>(boxes.size()), line,
                                  pattern_, samples()));
  }
  return all;
}

StillGroups ZBuffer::keep(std::uint32_t line, StillLines& still) {
  if (!still.lines().has(line) || !still.begin_line(line, groups_.count())) return own_still();
  for (std::uint32_t s = 0; s < samples_a_pixel(); ++s) {
    const auto kept = still.depth(line, s);
    std::copy_n(depth(s), kept.size(), kept.data());
    counts_.still_bytes += kept.size_bytes();
  }
  counts_.still_bytes += groups_.count() * sizeof(StillGroup);
  return several() ? still.groups(line) : own_still();
}

void ZBuffer::take_depths(std::uint32_t line, const shading::Extent& extent, StillLines& still) {
  for (std::uint32_t s = 0; s < samples_a_pixel(); ++s)
    std::copy_n(still.depth(line, s).data() + extent.first, extent.last - extent.first, depth(s) + extent.first);
  counts_.still_bytes += std::uint64_t{extent.last - extent.first} * samples_a_pixel() * sizeof(float);
}

void ZBuffer::shade_groups(const shading::Shading& shading, std::uint32_t line, const shading::Extent& extent) {
  counts_.shaded += groups_.shade(shading, samples(), line, extent);
}

// With one sample a pixel: shades what is seen, and forgets it.
void ZBuffer::put_samples(const shading::Shading& shading, std::uint32_t line, const shading::Extent& extent,
                          StripBuffer::Layer& out) {
  if (is_empty(extent)) return;
  const auto shaded = shading_kernels_.shade(shading, ids(0), line, extent, out.next_run(), out.next_pixel());
  counts_.shaded += shaded.counts;
  out.added(shaded);
  forget_ids(extent);
}

void ZBuffer::forget_depths(const shading::Extent& extent) {
  if (is_empty(extent)) return;
  for (std::uint32_t s = 0; s < samples_a_pixel(); ++s)
    std::fill(depth(s) + extent.first, depth(s) + extent.last, 0.0f);
}

void ZBuffer::forget_ids(const shading::Extent& extent) {
  if (is_empty(extent)) return;
  for (std::uint32_t s = 0; s < samples_a_pixel(); ++s)
    std::fill(ids(s) + extent.first, ids(s) + extent.last, shading::kNoTriangle);
}

}  // namespace mars::raster
