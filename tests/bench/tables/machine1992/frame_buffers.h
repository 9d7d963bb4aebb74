// A node's buffers (thesis figure 4.6), of the whole picture: CFB and CZB, MFB and MZB.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "node/geometry/line_range.h"

namespace mars::machine1992 {

// One frame buffer and its z-buffer.
struct Layer {
  Layer(std::uint32_t columns, std::uint32_t lines)
      : width(columns), pixels(std::size_t{columns} * lines), depths(pixels.size()) {}

  void clear(const geometry::LineRange& lines);
  std::span<std::uint32_t> pixels_of(std::uint32_t line) { return std::span(pixels).subspan(line * width, width); }
  std::span<float> depths_of(std::uint32_t line) { return std::span(depths).subspan(line * width, width); }

  std::uint32_t width;
  std::vector<std::uint32_t> pixels;
  std::vector<float> depths;  // 1 / distance: 0 where nothing is
};

struct FrameBuffers {
  FrameBuffers(std::uint32_t width, std::uint32_t lines) : constant(width, lines), moving(width, lines) {}

  Layer constant;
  Layer moving;
};

}  // namespace mars::machine1992
