// Encodes the bands of frames' files (picture_bands.h), in any format.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/images/picture_bands.h"

namespace mars::images {

// Of lines of such pictures, as a file has them.
std::size_t file_words_of(const PictureBands& bands, const Lines& lines);

// A band's pixels as a file has them: those that were drawn, or made of them.
class FilePixels {
 public:
  // `drawn` outlives it.
  FilePixels(const PictureBands& bands, std::span<const std::uint32_t> drawn);
  FilePixels(auto&&, std::same_as<std::vector<std::uint32_t>> auto&&) = delete;

  std::span<const std::uint32_t> words() const { return made_.empty() ? drawn_ : made_; }

 private:
  std::span<const std::uint32_t> drawn_;
  std::vector<std::uint32_t> made_;
};

// `pixels`: of the band's lines, as a file has them (layers.h).
EncodedBand encode_band(const PictureBands& bands, std::size_t band, std::span<const std::uint32_t> pixels);

// Of a file whose bands, all that the picture has, are `parts`.
PictureEnds ends_of(const PictureBands& bands, std::span<const BandPart> parts, const FileFacts& facts);

}  // namespace mars::images
