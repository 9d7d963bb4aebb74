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
  // put(place, box) for each edge box of the lines, at its line's place. A triangle's boxes on one line follow each
  // other, so that the place stays at hand.
  const auto for_each = [this, first_triangle](std::span<const UnsortedEdgeBox> all, std::uint64_t* places,
                                               const auto& put) {
    const std::uint32_t first = lines_.first, count = lines_.count();
    for (const UnsortedEdgeBox *next = all.data(), *const end = next + all.size(); next != end;) {
      const std::uint16_t of_line = next->line;
      const std::uint32_t line = of_line - first;
      if (line >= count) {
        ++next;
        continue;
      }
      std::uint64_t place = places[line];
      for (; next != end && next->line == of_line; ++next) {
        EdgeBox box = next->box;
        box.triangle += first_triangle;
        put(place, box);
      }
      places[line] = place;
    }
  };
  EdgeBox* const boxes = boxes_.data();
  for_each(polygons.stationary, stationary_.data(),
           [boxes](std::uint64_t& place, const EdgeBox& box) { boxes[place++] = box; });
  for_each(polygons.moving, moving_.data(),
           [boxes](std::uint64_t& place, const EdgeBox& box) { boxes[--place] = box; });
}

LineBoxes LineFiller::finish() const {
  check(std::equal(stationary_.begin(), stationary_.end(), moving_.begin()),
        "the edge boxes of a line are those that were counted");
  return {lines_, boxes_, end_, stationary_};
}

}  // namespace mars::raster
