#include "node/group/group_sums.h"

#include <algorithm>

#include "hal/collectives/group_sum.h"
#include "hal/nx/nx_messages.h"

namespace mars::group {

GroupSums::GroupSums(std::size_t lines, std::size_t nodes)
    : sent_(lines + nodes), work_(lines + nodes), ebc_(lines + 1) {
  own_bytes_.reserve(nodes);
}

void GroupSums::add_up(const collectives::Group& group, std::span<const std::uint32_t> line_counts,
                       std::uint64_t own_bytes) {
  const std::size_t lines = line_counts.size();
  const auto sums = std::span(sent_).first(lines + static_cast<std::size_t>(group.count));
  const auto totals = sums.first(lines), bytes = sums.subspan(lines);
  double total = 0;
  for (std::size_t line = 0; line < lines; ++line) totals[line] = total += line_counts[line];
  std::ranges::fill(bytes, 0.0);
  bytes[static_cast<std::size_t>(mynode() - group.first)] = static_cast<double>(own_bytes);
  if (group.count > 1) collectives::group_sum(group, sums, std::span(work_).first(sums.size()));
  std::ranges::transform(totals, ebc_.begin() + 1, [](double sum) { return static_cast<std::uint64_t>(sum); });
  own_bytes_.assign(bytes.begin(), bytes.end());
}

}  // namespace mars::group
