#include "node/wire/still_plan.h"

#include <algorithm>

namespace mars::wire {
StillPlan plan_still_lines(std::uint32_t width, std::uint32_t height, std::uint32_t samples, std::uint64_t bytes,
                           std::uint32_t casting, bool has_layers) {
  if (samples == 1 && casting == 0) return {width * sizeof(float), 0, height};
  for (std::uint32_t groups = samples;; groups /= 2) {
    const std::size_t group = still_group_bytes(casting) + surface_bytes(has_layers);
    const std::size_t column = still_column_bytes(samples, casting) + groups * group;
    const std::size_t line = whole_cache_lines(still_head_bytes(width) + width * column);
    const auto lines = static_cast<std::uint32_t>(std::min<std::uint64_t>(height, bytes / line));
    if (lines == height || groups == 1) return {line, groups, lines};
  }
}

}  // namespace mars::wire
