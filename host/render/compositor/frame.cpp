#include "host/render/compositor/frame.h"

namespace mars::compositor {

Frame::Frame(std::uint32_t width, std::uint32_t height, std::uint32_t block, std::uint32_t plain)
    : width(width),
      height(height),
      pixels(std::size_t{width} * height, plain),
      changed(width, height, block),
      plain(plain),
      constant(width, height, block),
      overwritten(width, height, block),
      stale(width, height, block) {}

}  // namespace mars::compositor
