// DEFLATE (RFC 1951) for rows of pixels as PNG files have them, filtered: fast, and the same bytes on every CPU. It
// seeks repeats of one byte and of one pixel only, which is what filtered pictures have; on rendered frames that takes
// a third of the time of zlib's run lengths (Z_RLE at level 1), for files that are about as large, or smaller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/wire/pixel_format.h"

namespace mars::images {

struct DeflatedRows {
  std::vector<std::byte> bytes;  // whole blocks, none of them the last, up to a whole byte: others may follow
  std::uint32_t adler32;         // of the filtered rows
  std::size_t row_bytes;         // of the filtered rows
};

// `pixels`: words of rows of `width` pixels, of rgb8 or rgb16. The first row is filtered by SUB, the others by UP: the
// bytes depend on these pixels alone.
DeflatedRows deflate_rows(std::span<const std::uint32_t> pixels, std::size_t width, wire::PixelFormat format);

}  // namespace mars::images
