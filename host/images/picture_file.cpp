#include "host/images/picture_file.h"

#include <algorithm>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/images/encode_bands.h"
#include "host/images/exr_file.h"
#include "host/images/picture_bands.h"
#include "host/images/png_file.h"
#include "node/wire/film_parts.h"

namespace mars::images {
namespace {

// Of the largest picture, not compressed, with 4 channels of 16 bits or layers; the rest is for what else a file holds.
std::uintmax_t largest_file(wire::PixelFormat pixels) {
  const std::uintmax_t bytes = std::max(std::size_t{2}, file_words(pixels)) * sizeof(std::uint32_t);
  return bytes * wire::kMaxSide * wire::kMaxSide + (1 << 24);
}
constexpr std::size_t kLargestStart = 4096;  // bytes, in which notes end

}  // namespace

std::vector<std::byte> encode_picture(PictureFormat format, std::uint32_t width, std::uint32_t height,
                                      std::span<const std::uint32_t> pixels, const std::string& note) {
  return encode_picture(PictureBands(format, width, height), pixels, {.note = note});
}

std::vector<std::byte> encode_picture(const PictureBands& bands, std::span<const std::uint32_t> pixels,
                                      const FileFacts& facts) {
  check(pixels.size() == file_words_of(bands, {0, bands.height()}), "a picture has width * height pixels");
  std::vector<EncodedBand> encoded;
  std::vector<BandPart> parts;
  for (std::size_t band = 0; band < bands.count(); ++band) {
    encoded.push_back(encode_band(bands, band, bands.part_of(pixels, band)));
  }
  for (const EncodedBand& band : encoded) parts.push_back(band.part());
  auto [file, after] = ends_of(bands, parts, facts);
  for (const EncodedBand& band : encoded) file.insert(file.end(), band.bytes.begin(), band.bytes.end());
  file.insert(file.end(), after.begin(), after.end());
  return std::move(file);
}

std::optional<std::string> read_note(const std::filesystem::path& path) {
  const std::string start = document::read_start(path, kLargestStart);
  const auto bytes = std::as_bytes(std::span(start));
  const std::optional<std::string> note = note_in_png(bytes);
  return note ? note : note_in_exr(bytes);
}

Image read_picture(PictureFormat format, const std::filesystem::path& path, wire::LayerSet layers) {
  const std::string file = document::read_file(path, largest_file(pixels_of(format, layers)));
  const auto bytes = std::as_bytes(std::span(file));
  switch (format) {
    case PictureFormat::png16: return decode_png16(bytes, path.string());
    case PictureFormat::png_alpha: return decode_png_with_alpha(bytes, path.string());
    case PictureFormat::png16_alpha: return decode_png16_with_alpha(bytes, path.string());
    case PictureFormat::exr:
    case PictureFormat::exr_alpha: return decode_exr(bytes, path.string(), pixels_of(format, layers));
    default: return decode_png(bytes, path.string());
  }
}

Image read_opaque(const std::filesystem::path& path) {
  Image image = read_picture(PictureFormat::png_alpha, path);
  for (std::uint32_t& pixel : image.pixels) {
    const std::uint32_t alpha = pixel >> 24;
    std::uint32_t shown = 0;
    for (int shift = 0; shift < 24; shift += 8) shown |= ((pixel >> shift & 0xff) * alpha + 127) / 255 << shift;
    pixel = shown;
  }
  return image;
}

}  // namespace mars::images
