#include "node/raster/scanline.h"

#include <algorithm>

#include "hal/failure/failure.h"

namespace mars::raster {

std::span<const EdgeBox> LineBoxes::stationary(std::uint32_t line) const {
  const std::size_t i = line - lines.first;
  const std::uint64_t begin = i == 0 ? 0 : end[i - 1];
  return boxes.subspan(begin, stationary_end[i] - begin);
}

std::span<const EdgeBox> LineBoxes::moving(std::uint32_t line) const {
  const std::size_t i = line - lines.first;
  return boxes.subspan(stationary_end[i], end[i] - stationary_end[i]);
}

bool LineBoxes::any_stationary() const {
  for (std::uint32_t line = lines.first; line < lines.last; ++line)
    if (!stationary(line).empty()) return true;
  return false;
}

LineFiller::LineFiller(const geometry::LineRange& lines, std::span<const std::uint64_t> ebc,
                       const geometry::Triangle* first, Arena& arena)
    : lines_(lines),
      first_(first),
      boxes_(arena.take<EdgeBox>(ebc[lines.last] - ebc[lines.first])),
      end_(arena.take<std::uint64_t>(lines.count())),
      stationary_(arena.take<std::uint64_t>(lines.count())),
      moving_(arena.take<std::uint64_t>(lines.count())) {
  for (std::size_t i = 0; i < end_.size(); ++i) {
    stationary_[i] = ebc[lines.first + i] - ebc[lines.first];
    end_[i] = moving_[i] = ebc[lines.first + i + 1] - ebc[lines.first];
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
        "the edge boxes of a line are those EBC counted");
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

void ZBuffer::draw_keyframe(const LineBoxes& boxes, const geometry::LineRange& part, const shading::Shading& shading,
                            const geometry::LineRange& czb_lines, Czb& czb, StripBuffer& out) {
  for (std::uint32_t line = part.first; line < part.last; ++line) {
    const auto stationary = boxes.stationary(line), moving = boxes.moving(line);
    if (stationary.empty() && moving.empty() && !czb_lines.has(line)) continue;
    std::fill_n(depth(), width_, 0.0f);
    draw(stationary, shading, line, out.constant());
    if (czb_lines.has(line)) std::copy_n(depth(), width_, czb.lines({line, line + 1}).data());
    // MZB starts as CZB: nearer than it is nearer than both, and of equals what stands still was there first.
    draw(moving, shading, line, out.moving());
  }
}

void ZBuffer::draw_inbetween(const LineBoxes& boxes, const geometry::LineRange& part, const shading::Shading& shading,
                             const geometry::LineRange& czb_lines, Czb& czb, StripBuffer& out) {
  for (std::uint32_t line = part.first; line < part.last; ++line) {
    const auto moving = boxes.moving(line);
    if (moving.empty()) continue;
    check(czb_lines.has(line), "moving parts stay on the lines that were foreseen");
    std::uint32_t first = moving[0].first, last = moving[0].last;
    for (const EdgeBox& box : moving) {
      first = std::min<std::uint32_t>(first, box.first);
      last = std::max<std::uint32_t>(last, box.last);
    }
    std::copy_n(czb.lines({line, line + 1}).data() + first, last - first, depth() + first);
    draw(moving, shading, line, out.moving());
  }
}

// Draws the line's boxes, shades what their ids show and forgets these.
void ZBuffer::draw(std::span<const EdgeBox> boxes, const shading::Shading& shading, std::uint32_t line,
                   StripBuffer::Layer& out) {
  if (boxes.empty()) return;
  const shading::Extent extent =
      kernels_.draw(shading.triangles, boxes.data(), static_cast<std::uint32_t>(boxes.size()), line, depth(), ids());
  out.added(shading_kernels_.shade(shading, ids(), line, extent, out.next_run(), out.next_pixel()));
  std::fill(ids() + extent.first, ids() + extent.last, shading::kNoTriangle);
}

}  // namespace mars::raster
