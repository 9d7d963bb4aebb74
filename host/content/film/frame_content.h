// What decides a frame's pixels (changed_frames.h says what does), as one checksum: it is the same for frames of two
// films, or of one film before and after an edit, where a rendering gives the same pixels, and other where anything
// that changed_frames compares differs. Frames' files carry it (host/render/sinks/frame_mark.h).
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "host/content/document/checksum.h"
#include "node/wire/film.h"
#include "node/wire/pixel_format.h"

namespace mars::film {

// Without what decides no pixel.
wire::FilmSettings shown_settings(wire::FilmSettings settings);

class FrameContent {
 public:
  // `film` must outlive it. `layers`: of the frames' files.
  explicit FrameContent(const wire::PackedFilm& film, wire::LayerSet layers = 0) : film_(film), layers_(layers) {}

  // 32 hexadecimal digits; from several threads at once. The first call reads all shapes.
  std::string checksum(std::uint32_t frame) const;

 private:
  void add_place(const wire::Segment& segment, std::uint32_t frame, document::Checksum& sum) const;
  void add_layers(std::uint32_t frame, document::Checksum& sum) const;

  const wire::PackedFilm film_;
  const wire::LayerSet layers_;
  mutable std::once_flag read_;
  mutable std::vector<std::string> shapes_;  // their checksums
};

}  // namespace mars::film
