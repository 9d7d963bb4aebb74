#include "host/render/watch/flagged_rects.h"

#include <algorithm>

namespace mars::watch {

std::vector<Rect> flagged_rects(const compositor::BlockFlags& flags, std::uint32_t width, std::uint32_t height) {
  std::vector<Rect> rects;
  std::size_t above = 0, end_above = 0;  // rectangles that end where the row begins
  for (std::uint32_t row = 0; row < flags.rows(); ++row) {
    const std::uint32_t y = row * flags.block(), lines = std::min(height - y, flags.block());
    const std::size_t begin = rects.size();
    std::vector<Rect> grown;
    flags.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) {
      const std::uint32_t x = first * flags.block(), right = std::min(width, last * flags.block());
      grown.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                       static_cast<std::uint16_t>(right - x), static_cast<std::uint16_t>(lines)});
    });
    for (Rect& rect : grown) {
      const auto same = [&](const Rect& other) { return other.x == rect.x && other.width == rect.width; };
      const auto found = std::find_if(rects.begin() + static_cast<std::ptrdiff_t>(above),
                                      rects.begin() + static_cast<std::ptrdiff_t>(end_above), same);
      if (found == rects.begin() + static_cast<std::ptrdiff_t>(end_above)) continue;
      rect.y = found->y;
      rect.height = static_cast<std::uint16_t>(rect.height + found->height);
      found->height = 0;
    }
    rects.insert(rects.end(), grown.begin(), grown.end());
    above = begin;
    end_above = rects.size();
  }
  std::erase_if(rects, [](const Rect& rect) { return rect.height == 0; });
  return rects;
}

}  // namespace mars::watch
