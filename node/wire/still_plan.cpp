#include "node/wire/still_plan.h"

#include <algorithm>

namespace mars::wire {
namespace {

constexpr std::size_t whole_cache_lines(std::size_t bytes) { return (bytes + 63) / 64 * 64; }

}  // namespace

StillPlan plan_still_lines(std::uint32_t width, std::uint32_t height, std::uint32_t samples, std::uint64_t bytes,
                           std::uint32_t casting) {
  const std::size_t depths = std::size_t{width} * samples * sizeof(float);
  if (samples == 1 && casting == 0) return {depths, 0, height};
  for (std::uint32_t groups = samples;; groups /= 2) {
    const std::size_t counts = std::size_t{width} * (sizeof(std::uint32_t) + casting * sizeof(StillPairs));
    const std::size_t line =
        whole_cache_lines(kStillHeadBytes + depths + counts + std::size_t{width} * groups * still_group_bytes(casting));
    const auto lines = static_cast<std::uint32_t>(std::min<std::uint64_t>(height, bytes / line));
    if (lines == height || groups == 1) return {line, groups, lines};
  }
}

}  // namespace mars::wire
