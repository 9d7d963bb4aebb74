// The file of a frame in parts: what stands before its pixels, one part for each band of lines, and what follows. A
// band's part depends on the band's own pixels alone, and bands are cut by the picture's size and format alone: so a
// band that has not changed is not encoded again, whoever encodes bands, and a file is the same byte for byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/images/layers.h"
#include "host/images/picture_format.h"
#include "host/images/picture_place.h"

namespace mars::images {

struct Lines {
  std::uint32_t first, end;

  std::uint32_t count() const { return end - first; }
};

class PictureBands {
 public:
  // `compression` and `layers`: of EXR files; `samples`: of a pixel of pictures that are drawn with layers.
  PictureBands(PictureFormat format, std::uint32_t width, std::uint32_t height,
               Compression compression = Compression::zip, const PicturePlace& place = {}, wire::LayerSet layers = 0,
               std::uint32_t samples = 0);

  // Of pictures with layers: the film that they show. Files are read without.
  void set_film(const wire::PackedFilm& film);
  const SurfaceNames* names() const { return names_.get(); }

  PictureFormat format() const { return format_; }
  // Of pictures as they are drawn.
  wire::PixelFormat pixels() const { return pixels_of(format_, layers_, samples_); }
  Compression compression() const { return compression_; }
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  const PicturePlace& place() const { return place_; }

  std::size_t count() const { return (height_ + lines_ - 1) / lines_; }
  std::uint32_t lines_a_band() const { return lines_; }
  Lines lines_of(std::size_t band) const;
  std::uint32_t band_of(std::uint32_t line) const { return line / lines_; }
  // Of one of its lines, or of all lines of a picture, in words of pixels as they are drawn.
  std::size_t words_of(const Lines& lines) const;
  // Of all words of a picture those of a band: as they are drawn, or as a file has them.
  std::span<const std::uint32_t> part_of(std::span<const std::uint32_t> pixels, std::size_t band) const;

 private:
  PictureFormat format_;
  Compression compression_;
  wire::LayerSet layers_;
  std::uint32_t samples_ = 0;  // of the film's pixels; 0: not known
  std::shared_ptr<const SurfaceNames> names_;
  std::uint32_t width_, height_;
  PicturePlace place_;
  std::uint32_t lines_;  // of every band but the last
};

// What a file has of a band.
struct BandPart {
  std::span<const std::byte> bytes;
  std::uint32_t adler32 = 0;    // PNG: of its filtered rows
  std::uint64_t row_bytes = 0;  // PNG: of the filtered rows
};

struct EncodedBand {
  std::vector<std::byte> bytes;
  std::uint32_t adler32 = 0;
  std::uint64_t row_bytes = 0;

  BandPart part() const { return {bytes, adler32, row_bytes}; }
};

// What a file says beside its pixels.
struct FileFacts {
  std::string note{};       // ASCII; "": none
  double rate = 0;          // EXR: frames a second; 0: not known
  std::uint32_t frame = 0;  // EXR: of the film
};

struct PictureEnds {
  std::vector<std::byte> before;
  std::vector<std::byte> after;
};

}  // namespace mars::images
