#include "host/images/picture_format.h"

#include <algorithm>
#include <array>

namespace mars::images {
namespace {

constexpr std::array<FormatFacts, 6> kFacts{
    {{"png", ".png", wire::PixelFormat::rgb8, "8-bit sRGB"},
     {"png16", ".png", wire::PixelFormat::rgb16, "16-bit sRGB"},
     {"exr", ".exr", wire::PixelFormat::half, "half-float linear RGB"},
     {"png-alpha", ".png", wire::PixelFormat::rgba8, "8-bit sRGB and alpha"},
     {"png16-alpha", ".png", wire::PixelFormat::rgba16, "16-bit sRGB and alpha"},
     {"exr-alpha", ".exr", wire::PixelFormat::half_alpha, "half-float linear RGB, premultiplied, and alpha"}}};

struct CompressionFacts {
  const char* name;
  std::uint32_t lines;  // of a chunk
};

constexpr std::array<CompressionFacts, 6> kCompressions{
    {{"zip", 16}, {"zips", 1}, {"piz", 32}, {"pxr24", 16}, {"rle", 1}, {"none", 1}}};

const CompressionFacts& facts_of(Compression compression) {
  return kCompressions.at(static_cast<std::size_t>(compression));
}

}  // namespace

const FormatFacts& facts_of(PictureFormat format) { return kFacts.at(static_cast<std::size_t>(format)); }

PictureFormat without_alpha(PictureFormat format) {
  return static_cast<PictureFormat>(static_cast<std::size_t>(format) % kColorFormats);
}

PictureFormat with_alpha(PictureFormat format) {
  return static_cast<PictureFormat>(static_cast<std::size_t>(without_alpha(format)) + kColorFormats);
}

bool has_alpha(PictureFormat format) { return wire::has_alpha(facts_of(format).pixels); }

bool is_exr(PictureFormat format) { return without_alpha(format) == PictureFormat::exr; }

std::optional<PictureFormat> picture_format_of(std::string_view name) {
  const auto found = std::ranges::find_if(kFacts, [&](const FormatFacts& facts) { return facts.name == name; });
  if (found == kFacts.end()) return std::nullopt;
  return static_cast<PictureFormat>(found - kFacts.begin());
}

bool is_picture_name(const std::filesystem::path& file) {
  return std::ranges::any_of(kFacts, [&](const FormatFacts& facts) { return file.extension() == facts.ending; });
}

const char* name_of(Compression compression) { return facts_of(compression).name; }

std::uint32_t chunk_lines(Compression compression) { return facts_of(compression).lines; }

std::optional<Compression> compression_of(std::string_view name) {
  const auto found = std::ranges::find_if(kCompressions, [&](const auto& facts) { return facts.name == name; });
  if (found == kCompressions.end()) return std::nullopt;
  return static_cast<Compression>(found - kCompressions.begin());
}

}  // namespace mars::images
