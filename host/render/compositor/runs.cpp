#include "host/render/compositor/runs.h"

#include <cstring>

namespace mars::compositor {
namespace {

// The first and the last `n` of `count` words, n <= count <= 2n: all of them.
template <std::size_t n>
void copy_ends(const std::uint32_t* from, std::size_t count, std::uint32_t* to) {
  std::memcpy(to, from, n * sizeof *from);
  std::memcpy(to + count - n, from + count - n, n * sizeof *from);
}

// Short runs are too many to call memcpy for each.
void copy_run(const std::uint32_t* from, std::size_t count, std::uint32_t* to) {
  if (count > 16)
    std::memcpy(to, from, count * sizeof *from);
  else if (count >= 8)
    copy_ends<8>(from, count, to);
  else if (count >= 4)
    copy_ends<4>(from, count, to);
  else if (count >= 2)
    copy_ends<2>(from, count, to);
  else
    *to = *from;
}

// Copies the runs' pixels, each of `pixel_words` words, which begin at `source`; returns where they end.
[[gnu::always_inline]] inline const std::uint32_t* copy_pixels(std::size_t pixel_words, std::span<const wire::Run> runs,
                                                               const std::uint32_t* source, std::size_t width,
                                                               std::uint32_t* picture) {
  for (const wire::Run& run : runs) {
    const std::size_t count = run.count * pixel_words;
    copy_run(source, count, picture + (run.line * width + run.first) * pixel_words);
    source += count;
  }
  return source;
}

}  // namespace

const std::uint32_t* copy_runs(std::span<const wire::Run> runs, const std::uint32_t* source, const Extent& extent,
                               std::uint32_t* picture) {
  // Of the usual sizes the compiler knows the factor.
  switch (extent.pixel_words) {
    case 1: return copy_pixels(1, runs, source, extent.width, picture);
    case 2: return copy_pixels(2, runs, source, extent.width, picture);
    default: return copy_pixels(extent.pixel_words, runs, source, extent.width, picture);
  }
}

}  // namespace mars::compositor
