#include "host/images/picture_file.h"

#include "host/content/document/file.h"
#include "host/images/exr_file.h"
#include "host/images/png_file.h"
#include "node/wire/film_parts.h"

namespace mars::images {
namespace {

// Of the largest picture, not compressed, with 4 channels of 16 bits; the rest is for what else a file holds.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{8} * wire::kMaxSide * wire::kMaxSide + (1 << 24);
constexpr std::size_t kLargestStart = 4096;  // bytes, in which notes end

}  // namespace

std::vector<std::byte> encode_picture(PictureFormat format, std::uint32_t width, std::uint32_t height,
                                      std::span<const std::uint32_t> pixels, const std::string& note) {
  switch (format) {
    case PictureFormat::png16: return encode_png16(width, height, pixels, note);
    case PictureFormat::exr: return encode_exr(width, height, pixels, note);
    default: return encode_png(width, height, pixels, note);
  }
}

std::optional<std::string> read_note(const std::filesystem::path& path) {
  const std::string start = document::read_start(path, kLargestStart);
  const auto bytes = std::as_bytes(std::span(start));
  const std::optional<std::string> note = note_in_png(bytes);
  return note ? note : note_in_exr(bytes);
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
