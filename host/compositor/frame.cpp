#include "host/compositor/frame.h"

namespace mars::host {

Frame::Frame(std::uint32_t width, std::uint32_t height, std::uint32_t block)
    : width(width),
      height(height),
      pixels(std::size_t{width} * height),
      changed(width, height, block),
      overwritten(width, height, block) {}

}  // namespace mars::host
