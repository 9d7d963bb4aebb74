#include "host/images/picture_bands.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "node/wire/pixel_format.h"

namespace mars::images {
namespace {

// Few enough that a small change costs little, and enough that what each band has of its own (a code, a first line that
// is not compared with the one above) is below a hundredth of it.
constexpr std::uint32_t kPixelsOfBand = 1 << 15;
// A band has a multiple of them, in lines.
constexpr std::uint32_t kPngStep = 8, kExrStep = 16;

constexpr std::uint32_t round_up(std::uint32_t number, std::uint32_t step) { return (number + step - 1) / step * step; }

}  // namespace

PictureBands::PictureBands(PictureFormat format, std::uint32_t width, std::uint32_t height, Compression compression,
                           const PicturePlace& place, wire::LayerSet layers, std::uint32_t samples)
    : format_(format),
      compression_(compression),
      layers_(layers),
      samples_(samples),
      width_(width),
      height_(height),
      place_(place) {
  check(width > 0 && height > 0, "a picture has pixels");
  const bool exr = is_exr(format);
  const std::uint32_t step = exr ? std::max(kExrStep, chunk_lines(compression)) : kPngStep;
  lines_ = round_up((kPixelsOfBand + width - 1) / width, step);
}

void PictureBands::set_film(const wire::PackedFilm& film) {
  if (layers_ == 0) return;
  samples_ = film.settings().samples;
  if ((layers_ & wire::set_of(wire::Layer::surfaces)) != 0) names_ = std::make_shared<SurfaceNames>(film);
}

Lines PictureBands::lines_of(std::size_t band) const {
  const auto first = static_cast<std::uint32_t>(band) * lines_;
  return {first, std::min(height_, first + lines_)};
}

std::size_t PictureBands::words_of(const Lines& lines) const {
  return std::size_t{lines.count()} * width_ * wire::pixel_words(pixels());
}

std::span<const std::uint32_t> PictureBands::part_of(std::span<const std::uint32_t> pixels, std::size_t band) const {
  const Lines lines = lines_of(band);
  const std::size_t words = pixels.size() / height_;  // of a line
  return pixels.subspan(lines.first * words, lines.count() * words);
}

}  // namespace mars::images
