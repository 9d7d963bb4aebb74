#include "tests/bench/tables/machine1992/frame_buffers.h"

#include <algorithm>

namespace mars::machine1992 {

void Layer::clear(const geometry::LineRange& lines) {
  const std::size_t first = std::size_t{lines.first} * width, count = std::size_t{lines.count()} * width;
  std::ranges::fill(std::span(pixels).subspan(first, count), 0u);
  std::ranges::fill(std::span(depths).subspan(first, count), 0.0f);
}

}  // namespace mars::machine1992
