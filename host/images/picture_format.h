// File formats of frames, and the pixels that each holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "node/wire/pixel_format.h"

namespace mars::images {

// In this order, with alpha and without.
enum class PictureFormat { png, png16, exr, png_alpha, png16_alpha, exr_alpha };
inline constexpr std::size_t kColorFormats = 3;

// Of EXR files. OpenEXR has others, which change half floats: a frame's pixels would not have their hash.
enum class Compression { zip, zips, piz, pxr24, rle, none };

struct FormatFacts {
  const char* name;    // as people write it
  const char* ending;  // of file names
  wire::PixelFormat pixels;
  const char* pixels_text;
};

const FormatFacts& facts_of(PictureFormat format);

PictureFormat without_alpha(PictureFormat format);
PictureFormat with_alpha(PictureFormat format);
bool has_alpha(PictureFormat format);
bool is_exr(PictureFormat format);

// None where no format has this name.
std::optional<PictureFormat> picture_format_of(std::string_view name);

// Whether files of frames end as this one's name does.
bool is_picture_name(const std::filesystem::path& file);

const char* name_of(Compression compression);
std::optional<Compression> compression_of(std::string_view name);
// Lines that are compressed together.
std::uint32_t chunk_lines(Compression compression);

}  // namespace mars::images
