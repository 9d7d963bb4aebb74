#include "node/raster/scanline.h"

#include <algorithm>

#include "hal/failure/failure.h"

namespace mars::raster {
namespace {

// The triangles of the first boxes, which the kernel has no time to fetch ahead.
void fetch(const geometry::Triangle* triangles, std::span<const EdgeBox> boxes) {
  constexpr std::size_t kFirst = 32;
  for (const EdgeBox& box : boxes.first(std::min(boxes.size(), kFirst))) __builtin_prefetch(triangles + box.triangle);
}

}  // namespace

std::span<const EdgeBox> LineBoxes::of(std::uint32_t line) const {
  return boxes.subspan(begin(line), end[line - lines.first] - begin(line));
}

std::span<const EdgeBox> LineBoxes::stationary(std::uint32_t line) const {
  return boxes.subspan(begin(line), stationary_end[line - lines.first] - begin(line));
}

std::span<const EdgeBox> LineBoxes::moving(std::uint32_t line) const {
  const std::size_t i = line - lines.first;
  return boxes.subspan(stationary_end[i], end[i] - stationary_end[i]);
}

std::uint64_t LineBoxes::count(const geometry::LineRange& some) const {
  return some.count() == 0 ? 0 : end[some.last - 1 - lines.first] - begin(some.first);
}

bool any_stationary(LineParts parts, const geometry::LineRange& lines) {
  for (std::uint32_t line = lines.first; line < lines.last; ++line)
    for (const LineBoxes& part : parts)
      if (!part.stationary(line).empty()) return true;
  return false;
}

LineFiller::LineFiller(const geometry::LineRange& lines, std::span<const std::uint64_t> totals,
                       const geometry::Triangle* first, Arena& arena)
    : lines_(lines),
      first_(first),
      boxes_(arena.take<EdgeBox>(totals[lines.count()] - totals[0])),
      end_(arena.take<std::uint64_t>(lines.count())),
      stationary_(arena.take<std::uint64_t>(lines.count())),
      moving_(arena.take<std::uint64_t>(lines.count())) {
  for (std::size_t i = 0; i < end_.size(); ++i) {
    stationary_[i] = totals[i] - totals[0];
    end_[i] = moving_[i] = totals[i + 1] - totals[0];
  }
}

void LineFiller::add(const Polygons& polygons) {
  const auto first_triangle = static_cast<std::uint32_t>(polygons.triangles - first_);
  // put(line, box) for each edge box of these lines, `line` its line's number among them.
  const auto for_each = [this, first_triangle](std::span<const UnsortedEdgeBox> all, const auto& put) {
    const std::uint32_t first = lines_.first, count = lines_.count();
    for (const UnsortedEdgeBox unsorted : all) {
      const std::uint32_t line = unsorted.line - first;
      const EdgeBox box{first_triangle + unsorted.box.triangle, unsorted.box.first, unsorted.box.last};
      if (line < count) put(line, box);
    }
  };
  EdgeBox* const boxes = boxes_.data();
  for_each(polygons.stationary,
           [boxes, next = stationary_.data()](std::uint32_t line, const EdgeBox& box) { boxes[next[line]++] = box; });
  for_each(polygons.moving,
           [boxes, last = moving_.data()](std::uint32_t line, const EdgeBox& box) { boxes[--last[line]] = box; });
}

LineBoxes LineFiller::finish() const {
  check(std::equal(stationary_.begin(), stationary_.end(), moving_.begin()),
        "the edge boxes of a line are those that were counted");
  return {lines_, boxes_, end_, stationary_};
}

ZBuffer::ZBuffer(simd::InstructionSet set, std::int32_t width)
    : kernels_(raster_kernels(set)),
      shading_kernels_(shading::shading_kernels(set)),
      width_(static_cast<std::size_t>(width)),
      depths_((width_ - 1) / simd::kVectorSlack + 2),
      ids_(depths_.size()) {
  std::fill_n(ids(), ids_.size() * simd::kVectorSlack, shading::kNoTriangle);
}

void ZBuffer::draw_keyframe(LineParts parts, const geometry::LineRange& lines, const shading::Shading& shading,
                            const geometry::LineRange& czb_lines, Czb& czb, StripBuffer& out) {
  for (std::uint32_t line = lines.first; line < lines.last; ++line) {
    const bool empty = std::ranges::all_of(parts, [line](const LineBoxes& part) { return part.of(line).empty(); });
    if (empty && !czb_lines.has(line)) continue;
    std::fill_n(depth(), width_, 0.0f);
    draw(parts, &LineBoxes::stationary, shading, line, out.constant());
    if (czb_lines.has(line)) std::copy_n(depth(), width_, czb.lines({line, line + 1}).data());
    // MZB starts as CZB: nearer than it is nearer than both, and of equals what stands still was there first.
    draw(parts, &LineBoxes::moving, shading, line, out.moving());
  }
}

void ZBuffer::draw_inbetween(LineParts parts, const geometry::LineRange& lines, const shading::Shading& shading,
                             const geometry::LineRange& czb_lines, Czb& czb, StripBuffer& out) {
  for (std::uint32_t line = lines.first; line < lines.last; ++line) {
    std::uint32_t first = 0xffffffffu, last = 0;
    for (const LineBoxes& part : parts)
      for (const EdgeBox& box : part.moving(line)) {
        first = std::min<std::uint32_t>(first, box.first);
        last = std::max<std::uint32_t>(last, box.last);
      }
    if (first >= last) continue;
    check(czb_lines.has(line), "moving parts stay on the lines that were foreseen");
    std::copy_n(czb.lines({line, line + 1}).data() + first, last - first, depth() + first);
    draw(parts, &LineBoxes::moving, shading, line, out.moving());
  }
}

// Draws the line's boxes of one kind, shades what their ids show and forgets these.
void ZBuffer::draw(LineParts parts, BoxesOf kind, const shading::Shading& shading, std::uint32_t line,
                   StripBuffer::Layer& out) {
  shading::Extent all{0xffffffffu, 0};
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto boxes = (parts[p].*kind)(line);
    if (p + 1 < parts.size())
      fetch(shading.triangles, (parts[p + 1].*kind)(line));
    else if (line + 1 < parts[0].lines.last)
      fetch(shading.triangles, (parts[0].*kind)(line + 1));
    if (boxes.empty()) continue;
    const shading::Extent extent =
        kernels_.draw(shading.triangles, boxes.data(), static_cast<std::uint32_t>(boxes.size()), line, depth(), ids());
    all = {std::min(all.first, extent.first), std::max(all.last, extent.last)};
  }
  if (all.first >= all.last) return;
  auto* pixels = reinterpret_cast<std::uint32_t*>(out.next_pixel());
  out.added(shading_kernels_.shade(shading, ids(), line, all, out.next_run(), pixels));
  std::fill(ids() + all.first, ids() + all.last, shading::kNoTriangle);
}

}  // namespace mars::raster
