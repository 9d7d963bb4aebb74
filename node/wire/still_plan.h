// The memory of what inbetweens need of stationary parts (node/raster/still_lines.h), planned before a node has any of
// it: by nodes, and by the host for its report.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mars::wire {

// A shaded group of a pixel's still samples.
struct StillGroup {
  float light[3];
  std::uint32_t samples;  // one bit each
};

// With several samples a pixel each line has a head, depths, the number of groups up to each column, and the groups.
inline constexpr std::size_t kStillHeadBytes = 64;

struct StillPlan {
  std::size_t line_bytes;           // of a line
  std::uint32_t groups_per_column;  // that a line has memory for on average; 0 with one sample a pixel
  std::uint32_t lines;              // that fit

  std::size_t bytes() const { return line_bytes * lines; }
};

// For a picture of `width` x `height` within `bytes`. Where several samples do not fit, first lines have memory for
// fewer groups, then fewer lines are kept. With one sample a pixel all lines are kept, whatever they take.
StillPlan plan_still_lines(std::uint32_t width, std::uint32_t height, std::uint32_t samples, std::uint64_t bytes);

}  // namespace mars::wire
