#include "host/images/picture_file.h"

#include "host/content/document/file.h"
#include "host/images/exr_file.h"
#include "host/images/png_file.h"
#include "node/wire/film_parts.h"

namespace mars::images {
namespace {

// Of the largest picture, not compressed, with 4 channels of 16 bits; the rest is for what else a file holds.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{8} * wire::kMaxSide * wire::kMaxSide + (1 << 24);

}  // namespace

std::vector<std::byte> encode_picture(PictureFormat format, std::uint32_t width, std::uint32_t height,
                                      std::span<const std::uint32_t> pixels) {
  switch (format) {
    case PictureFormat::png16: return encode_png16(width, height, pixels);
    case PictureFormat::exr: return encode_exr(width, height, pixels);
    default: return encode_png(width, height, pixels);
  }
}

Image read_picture(PictureFormat format, const std::filesystem::path& path) {
  const std::string file = document::read_file(path, kLargestFile);
  const auto bytes = std::as_bytes(std::span(file));
  switch (format) {
    case PictureFormat::png16: return decode_png16(bytes, path.string());
    case PictureFormat::exr: return decode_exr(bytes, path.string());
    default: return decode_png(bytes, path.string());
  }
}

}  // namespace mars::images
