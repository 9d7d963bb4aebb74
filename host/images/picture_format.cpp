#include "host/images/picture_format.h"

#include <algorithm>
#include <array>

namespace mars::images {
namespace {

constexpr std::array<FormatFacts, 3> kFacts{{{"png", ".png", wire::PixelFormat::rgb8, "8-bit sRGB"},
                                             {"png16", ".png", wire::PixelFormat::rgb16, "16-bit sRGB"},
                                             {"exr", ".exr", wire::PixelFormat::half, "half-float linear RGB"}}};

}  // namespace

const FormatFacts& facts_of(PictureFormat format) { return kFacts.at(static_cast<std::size_t>(format)); }

std::optional<PictureFormat> picture_format_of(std::string_view name) {
  const auto found = std::ranges::find_if(kFacts, [&](const FormatFacts& facts) { return facts.name == name; });
  if (found == kFacts.end()) return std::nullopt;
  return static_cast<PictureFormat>(found - kFacts.begin());
}

}  // namespace mars::images
