#include "node/raster/czb.h"

namespace mars::raster {

namespace {

std::size_t bytes_of(std::int32_t width, std::int32_t height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * sizeof(float);
}

}  // namespace

Czb::Czb(const Neighbours& neighbours, std::int32_t width, std::int32_t height)
    : width_(static_cast<std::size_t>(width)),
      memory_(neighbours, bytes_of(width, height), bytes_of(width, height)),
      depth_(reinterpret_cast<float*>(memory_.bytes().data())) {}

std::span<float> Czb::lines(const geometry::LineRange& lines) {
  return {depth_ + lines.first * width_, lines.count() * width_};
}

}  // namespace mars::raster
