#include "node/raster/line_boxes.h"

#include <algorithm>

#include "hal/failure/failure.h"

namespace mars::raster {

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
      EdgeBox box = unsorted.box;
      box.triangle += first_triangle;
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

}  // namespace mars::raster
