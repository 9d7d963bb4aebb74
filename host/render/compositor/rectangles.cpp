#include "host/render/compositor/rectangles.h"

#include <algorithm>
#include <cstddef>

namespace mars::compositor {

std::vector<Rect> rectangles_of(const BlockFlags& flags, std::uint32_t width, std::uint32_t height) {
  const std::uint32_t block = flags.block();
  std::vector<Rect> rects;
  std::vector<std::size_t> above, here;  // numbers of those that reach down to the row, and of the row's, from the left
  for (std::uint32_t row = 0; row < flags.rows(); ++row) {
    const std::uint32_t top = row * block, lines = std::min(height - top, block);
    auto over = above.begin();
    flags.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) {
      const std::uint32_t left = first * block, columns = std::min(width, last * block) - left;
      while (over != above.end() && rects[*over].x < left) ++over;
      if (over != above.end() && rects[*over].x == left && rects[*over].width == columns) {
        rects[*over].height = static_cast<std::uint16_t>(rects[*over].height + lines);
        here.push_back(*over);
        return;
      }
      here.push_back(rects.size());
      rects.push_back({static_cast<std::uint16_t>(left), static_cast<std::uint16_t>(top),
                       static_cast<std::uint16_t>(columns), static_cast<std::uint16_t>(lines)});
    });
    above.swap(here);
    here.clear();
  }
  return rects;
}

}  // namespace mars::compositor
