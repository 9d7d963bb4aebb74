#include <algorithm>
#include <array>

#include "hal/failure/failure.h"
#include "host/images/exr_bands.h"
#include "host/images/exr_file.h"

namespace mars::images {
namespace {

[[noreturn]] void refuse(const std::string& file) {
  throw Failure("this MARS was built without OpenEXR", file,
                "install libopenexr-dev (./bootstrap does) and build again, or use PNG files");
}

}  // namespace

void check_exr_is_built() { refuse(""); }

// Other files, such as a foreign PNG file, have no note.
std::optional<std::string> note_in_exr(std::span<const std::byte> start) {
  constexpr std::array kMagic = {std::byte{0x76}, std::byte{0x2f}, std::byte{0x31}, std::byte{0x01}};
  if (start.size() >= kMagic.size() && std::ranges::equal(start.first(kMagic.size()), kMagic)) refuse("");
  return std::nullopt;
}

Image decode_exr(std::span<const std::byte>, const std::string& name, wire::PixelFormat) { refuse(name); }

EncodedBand encode_exr_band(const PictureBands&, const Lines&, std::span<const std::uint32_t>) { refuse(""); }

PictureEnds exr_ends(const PictureBands&, std::span<const BandPart>, const FileFacts&) { refuse(""); }

}  // namespace mars::images
