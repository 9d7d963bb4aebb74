#include "host/images/png_bands.h"

#include <zlib.h>

#include <cstddef>
#include <string_view>
#include <vector>

#include "host/images/deflated_rows.h"

namespace mars::images {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::string_view kFileStart = "\x89PNG\r\n\x1a\n";
constexpr char kStreamHead[] = {0x78, 0x01};      // RFC 1950: deflate, the fastest level
constexpr char kEmptyLastBlock[] = {0x03, 0x00};  // RFC 1951: of the fixed code

void append(Bytes& bytes, std::string_view text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  bytes.insert(bytes.end(), first, first + text.size());
}

// The highest byte first.
void append_number(Bytes& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::byte>(number >> shift));
}

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void append_chunk(Bytes& bytes, std::string_view type, std::string_view data) {
  append_number(bytes, static_cast<std::uint32_t>(data.size()));
  const std::size_t summed = bytes.size();
  append(bytes, type);
  append(bytes, data);
  append_number(bytes, static_cast<std::uint32_t>(
                           crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data() + summed), bytes.size() - summed)));
}

Bytes head_of(const PictureBands& bands) {
  Bytes head;
  append_number(head, bands.width());
  append_number(head, bands.height());
  const wire::PixelFormat pixels = facts_of(bands.format()).pixels;
  constexpr int kRgb = 2, kRgba = 6;
  const int bits = wire::colors_of(pixels) == wire::PixelFormat::rgb16 ? 16 : 8;
  const int type = wire::has_alpha(pixels) ? kRgba : kRgb;
  for (const int field : {bits, type, 0, 0, 0})  // deflate, filters by row, not interlaced
    head.push_back(static_cast<std::byte>(field));
  return head;
}

// Pixels per unit, which is none of length: the shape of a pixel.
Bytes shape_of(float pixel_aspect) {
  const Ratio ratio = ratio_of(pixel_aspect);
  Bytes shape;
  append_number(shape, ratio.height);  // along x
  append_number(shape, ratio.width);
  shape.push_back(std::byte{0});
  return shape;
}

std::uint32_t adler32_of(std::span<const BandPart> parts) {
  std::uint32_t sum = 1;
  for (const BandPart& band : parts)
    sum = static_cast<std::uint32_t>(adler32_combine(sum, band.adler32, static_cast<z_off_t>(band.row_bytes)));
  return sum;
}

}  // namespace

EncodedBand encode_png_band(std::uint32_t width, wire::PixelFormat format, std::span<const std::uint32_t> pixels) {
  const DeflatedRows rows = deflate_rows(pixels, width, format);
  EncodedBand band{{}, rows.adler32, rows.row_bytes};
  append_chunk(band.bytes, "IDAT", text_of(rows.bytes));
  return band;
}

PictureEnds png_ends(const PictureBands& bands, std::span<const BandPart> parts, const FileFacts& facts) {
  PictureEnds ends;
  append(ends.before, kFileStart);
  append_chunk(ends.before, "IHDR", text_of(head_of(bands)));
  append_chunk(ends.before, "sRGB", std::string_view("\0", 1));  // perceptual intent
  if (const float aspect = bands.place().pixel_aspect; aspect != 1)
    append_chunk(ends.before, "pHYs", text_of(shape_of(aspect)));
  if (!facts.note.empty()) append_chunk(ends.before, "tEXt", kPngNoteKeyword + std::string(1, '\0') + facts.note);
  append_chunk(ends.before, "IDAT", {kStreamHead, sizeof kStreamHead});
  Bytes last;
  append(last, {kEmptyLastBlock, sizeof kEmptyLastBlock});
  append_number(last, adler32_of(parts));
  append_chunk(ends.after, "IDAT", text_of(last));
  append_chunk(ends.after, "IEND", "");
  return ends;
}

}  // namespace mars::images
