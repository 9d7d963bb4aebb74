#include "node/raster/z_line.h"

#include <algorithm>

namespace mars::raster {
namespace {

// Rows of samples begin on cache lines and end with kVectorSlack to spare.
std::uint32_t stride_of(std::uint32_t width) {
  constexpr auto kSlack = static_cast<std::uint32_t>(simd::kVectorSlack);
  return (width - 1) / kSlack * kSlack + 2 * kSlack;
}

// The triangles of the first boxes, which the kernel has no time to fetch ahead.
void fetch(const geometry::Triangle* triangles, std::span<const EdgeBox> boxes) {
  constexpr std::size_t kFirst = 32;
  for (const EdgeBox& box : boxes.first(std::min(boxes.size(), kFirst))) __builtin_prefetch(triangles + box.triangle);
}

}  // namespace

shading::Extent both(const shading::Extent& a, const shading::Extent& b) {
  return {std::min(a.first, b.first), std::max(a.last, b.last)};
}

bool any_boxes(LineParts parts, BoxesOf kind, std::uint32_t line) {
  return std::ranges::any_of(parts, [=](const LineBoxes& part) { return !(part.*kind)(line).empty(); });
}

shading::Extent moving_extent(LineParts parts, std::uint32_t line) {
  shading::Extent extent = kNothing;
  for (const LineBoxes& part : parts)
    for (const EdgeBox& box : part.moving(line)) extent = both(extent, {box.first, box.last()});
  return extent;
}

ZLine::ZLine(simd::InstructionSet set, std::uint32_t width, const shape::SamplePattern& pattern, float nothing)
    : kernels_(raster_kernels(set)),
      pattern_(pattern),
      nothing_(nothing),
      stride_(stride_of(width)),
      depths_(static_cast<std::size_t>(pattern.count) * stride_ / simd::kVectorSlack),
      ids_(depths_.size()) {
  std::fill_n(depth(0), depths_.size() * simd::kVectorSlack, nothing);
  std::fill_n(ids(0), ids_.size() * simd::kVectorSlack, shading::kNoTriangle);
}

shading::Extent ZLine::draw(LineParts parts, BoxesOf kind, const geometry::Triangle* triangles, std::uint32_t line) {
  shading::Extent all = kNothing;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto boxes = (parts[p].*kind)(line);
    if (p + 1 < parts.size())
      fetch(triangles, (parts[p + 1].*kind)(line));
    else if (line + 1 < parts[0].lines.last)
      fetch(triangles, (parts[0].*kind)(line + 1));
    if (boxes.empty()) continue;
    all = both(all, kernels_.draw(triangles, boxes.data(), static_cast<std::uint32_t>(boxes.size()), line, pattern_,
                                  samples()));
  }
  return all;
}

void ZLine::forget_depths(const shading::Extent& extent) {
  if (is_empty(extent)) return;
  for (std::uint32_t s = 0; s < samples_a_pixel(); ++s)
    std::fill(depth(s) + extent.first, depth(s) + extent.last, nothing_);
}

void ZLine::forget_ids(const shading::Extent& extent) {
  if (is_empty(extent)) return;
  for (std::uint32_t s = 0; s < samples_a_pixel(); ++s)
    std::fill(ids(s) + extent.first, ids(s) + extent.last, shading::kNoTriangle);
}

}  // namespace mars::raster
