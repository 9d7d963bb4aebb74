#include "host/images/encode_bands.h"

#include "hal/failure/failure.h"
#include "host/images/exr_bands.h"
#include "host/images/png_bands.h"

namespace mars::images {

std::size_t file_words_of(const PictureBands& bands, const Lines& lines) {
  return std::size_t{lines.count()} * bands.width() * file_words(bands.pixels());
}

FilePixels::FilePixels(const PictureBands& bands, std::span<const std::uint32_t> drawn) : drawn_(drawn) {
  if (wire::has_layer(bands.pixels(), wire::Layer::surfaces)) made_ = to_file(bands.pixels(), bands.names(), drawn);
}

EncodedBand encode_band(const PictureBands& bands, std::size_t band, std::span<const std::uint32_t> pixels) {
  const Lines lines = bands.lines_of(band);
  check(pixels.size() == file_words_of(bands, lines), "a band has the pixels of its lines");
  if (is_exr(bands.format())) return encode_exr_band(bands, lines, pixels);
  return encode_png_band(bands.width(), facts_of(bands.format()).pixels, pixels);
}

PictureEnds ends_of(const PictureBands& bands, std::span<const BandPart> parts, const FileFacts& facts) {
  check(parts.size() == bands.count(), "a file has all bands of its picture");
  if (is_exr(bands.format())) return exr_ends(bands, parts, facts);
  return png_ends(bands, parts, facts);
}

}  // namespace mars::images
