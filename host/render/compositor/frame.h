// A picture the size of the film on its way from the compositor to the sinks. Its pixels stay where they
// are from one use to the next, so that the compositor needs to mend only the blocks it had overwritten.
// Pixels are rows from the top, each of some words: as strips have them (node/wire/pixel_format.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "host/render/compositor/background.h"
#include "host/render/compositor/block_flags.h"
#include "node/wire/pixel_format.h"

namespace mars::compositor {

struct Lines {
  std::uint32_t first, end;
};

struct Frame {
  // Every pixel is `plain`.
  Frame(std::uint32_t width, std::uint32_t height, std::uint32_t block, std::uint64_t plain = 0,
        wire::PixelFormat format = wire::PixelFormat::rgb8);

  std::uint32_t number = 0;  // of the film's frames, from 0
  std::uint32_t width;
  std::uint32_t height;
  wire::PixelFormat format;
  std::vector<std::uint32_t> pixels;  // their words

  // Blocks that may differ from frame `changed_since`; all of them when that is none.
  BlockFlags changed;
  std::optional<std::uint32_t> changed_since;

  // The compositor's: wherever no block is flagged as overwritten or stale, these pixels show the saved background
  // of that name (0: none but the plain one), which may differ from `plain` in the blocks flagged as constant. Stale
  // blocks show what the buffer was used for before.
  std::uint64_t plain;
  std::uint64_t background = 0;
  BlockFlags constant;
  BlockFlags overwritten;
  BlockFlags stale;
  std::shared_ptr<const Background> shown;  // that background; none in a free buffer

  // Whether only the background shows in these lines, as far as flags tell.
  bool shows_background(const Lines& lines) const;
  // Stale blocks on the lines show the background again; the bytes that were written.
  std::uint64_t restore(const Lines& lines);
};

}  // namespace mars::compositor
