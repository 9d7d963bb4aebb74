// Puts pictures together band by band, where they are drawn: pixels come from the top, and a band whose lines are all
// there is taken at once. So a node needs memory for a band, not for a picture.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "host/images/picture_bands.h"
#include "node/wire/run.h"

namespace mars::composer {

class BandComposer {
 public:
  // Pixels of one band, or of the part of it that begins with line `lines.first`, as words. `still`: without moving
  // parts; the same as `whole` where none touches it.
  struct Part {
    std::uint32_t band;
    images::Lines lines;
    bool is_touched;  // by moving parts
    std::span<const std::uint32_t> still, whole;
  };
  using Take = std::function<void(const Part& part)>;
  // Words of a band's stationary parts.
  using Still = std::function<std::span<const std::uint32_t>(std::uint32_t band)>;

  explicit BandComposer(const images::PictureBands& bands);

  // Lines [lines.first, lines.end) of a keyframe, on which `background` shows where nothing is drawn. `take` gets every
  // band of them, the first and the last perhaps in part.
  void begin_keyframe(const images::Lines& lines, std::uint64_t background, Take take);
  // Lines of an inbetween, whole bands: `take` gets the bands that moving parts touch.
  void begin_inbetween(const images::Lines& lines, Still still, Take take);

  // The next lines, up to `end`: the first `constant` runs are of stationary parts. Runs and words of pixels as in
  // wire::Strip, of which they have been checked.
  void paste(std::uint32_t end, std::span<const wire::Run> runs, std::size_t constant,
             std::span<const std::uint32_t> pixels);

 private:
  struct Layer {
    std::span<const wire::Run> runs;
    const std::uint32_t* pixels;
  };

  void paste_part(std::uint32_t end, Layer& constant, Layer& moving);
  void begin_band();
  void end_part();
  Layer cut(Layer& layer, std::uint32_t end) const;
  void copy(const Layer& layer, std::vector<std::uint32_t>& band) const;
  std::size_t word_of(std::uint32_t line) const;

  const images::PictureBands bands_;
  const std::size_t line_words_, pixel_words_;
  std::vector<std::uint32_t> still_, whole_;  // the current band's words
  Take take_;
  Still still_of_;  // of an inbetween
  std::uint64_t background_ = 0;
  images::Lines lines_{0, 0};  // of the frame that are drawn
  std::uint32_t next_ = 0;     // the next line
  std::uint32_t band_ = 0;     // that it is in
  images::Lines part_{0, 0};   // the lines of that band
  bool is_touched_ = false;    // the band
};

}  // namespace mars::composer
