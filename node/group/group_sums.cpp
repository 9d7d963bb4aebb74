#include "node/group/group_sums.h"

#include <algorithm>
#include <string>

#include "hal/collectives/group_sum.h"
#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "node/group/mapping.h"

namespace mars::group {

using raster::LineLoad;

GroupSums::GroupSums(std::size_t lines)
    : sums_(wire::summed_words(lines)), work_(sums_.size()), ebc_(lines + 1), costs_(lines + 1) {}

void GroupSums::add_up(const collectives::Group& group, const OwnLoad& own) {
  const std::size_t lines = own.lines.size();
  std::ranges::transform(own.lines, sums_.begin(), &LineLoad::packed);
  sums_[lines] = own.edge_boxes;
  sums_[lines + 1] = own.large ? 1 : 0;
  sums_[lines + 2] = own.exchange.sending;
  sums_[lines + 3] = own.exchange.making;
  if (group.count > 1) collectives::group_sum(group, sums_, work_);
  for (std::size_t line = 0; line < lines; ++line) {
    const LineLoad load = LineLoad::of_packed(sums_[line]);
    ebc_[line + 1] = ebc_[line] + load.boxes();
    costs_[line + 1] = costs_[line] + line_cost(load, own.still_bytes.empty() ? 0 : own.still_bytes[line]);
  }
  check_bounds(sums_[lines]);
}

// Each time that a line's samples go beyond their bits they add a box, and each time that its boxes do 2^28 are lost.
void GroupSums::check_bounds(std::uint64_t edge_boxes) const {
  if (ebc_.back() != edge_boxes)
    throw Failure("a line has more than " + std::to_string(LineLoad::kMostBoxes) +
                      " edge boxes, or these cover more than " + std::to_string(LineLoad::kMostSamples) + " samples",
                  "scanlines", "dice the film more coarsely");
}

std::uint64_t GroupSums::samples_on(const geometry::LineRange& range) const {
  std::uint64_t samples = 0;
  for (std::uint32_t line = range.first; line < range.last; ++line)
    samples += LineLoad::of_packed(sums_[line]).samples();
  return samples;
}

}  // namespace mars::group
