// The saved background of an interval (thesis 4.10): CFB over the plain background. It does not change any more once
// the interval's keyframe is finished; frames that show it share it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "host/render/compositor/block_flags.h"
#include "node/wire/pixel_format.h"

namespace mars::compositor {

struct Background {
  Background(std::uint32_t width, std::uint32_t height, std::uint32_t block, wire::PixelFormat format);

  // The columns [first, last) of blocks of a row of them show it in a picture, given as its words; the bytes that were
  // written.
  std::uint64_t write(std::uint32_t* picture, std::uint32_t row, std::uint32_t first, std::uint32_t last) const;

  const std::uint32_t width;
  const std::uint32_t height;
  const wire::PixelFormat format;
  const std::size_t pixel_words;
  std::uint64_t plain = 0;  // the pixel where nothing is drawn
  BlockFlags constant;      // blocks that have CFB
  // Plain background and CFB in these blocks, nothing elsewhere. Made when first needed; pages where no CFB ever was
  // are never touched.
  std::unique_ptr<std::uint32_t[]> saved;
};

}  // namespace mars::compositor
