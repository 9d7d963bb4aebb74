#include "host/render/composer/band_composer.h"

#include <algorithm>
#include <utility>

#include "host/render/compositor/plain_pixels.h"
#include "host/render/compositor/runs.h"
#include "node/wire/pixel_format.h"

namespace mars::composer {

BandComposer::BandComposer(const images::PictureBands& bands)
    : bands_(bands),
      line_words_(bands.words_of({0, 1})),
      pixel_words_(line_words_ / bands.width()),
      still_(bands.words_of(bands.lines_of(0))),
      whole_(still_.size()) {}

void BandComposer::begin_keyframe(const images::Lines& lines, std::uint64_t background, Take take) {
  take_ = std::move(take);
  still_of_ = nullptr;
  background_ = background;
  lines_ = lines;
  next_ = lines.first;
  if (lines.count() > 0) begin_band();
}

void BandComposer::begin_inbetween(const images::Lines& lines, Still still, Take take) {
  take_ = std::move(take);
  still_of_ = std::move(still);
  lines_ = lines;
  next_ = lines.first;
  if (lines.count() > 0) begin_band();
}

void BandComposer::begin_band() {
  band_ = bands_.band_of(next_);
  const images::Lines all = bands_.lines_of(band_);
  part_ = {next_, std::min(all.end, lines_.end)};
  is_touched_ = false;
  if (!still_of_) compositor::fill_pixels(still_, background_, bands_.pixels());
}

void BandComposer::paste(std::uint32_t end, std::span<const wire::Run> runs, std::size_t constant,
                         std::span<const std::uint32_t> pixels) {
  Layer still{runs.first(constant), pixels.data()};
  const std::uint32_t* first_moving = pixels.data();
  for (const wire::Run& run : still.runs) first_moving += run.count * pixel_words_;
  Layer moving{runs.subspan(constant), first_moving};
  while (next_ < end) paste_part(std::min(end, part_.end), still, moving);
}

// Lines up to `end`, all of the current band.
void BandComposer::paste_part(std::uint32_t end, Layer& constant, Layer& moving) {
  const Layer still = cut(constant, end), moved = cut(moving, end);
  copy(still, still_);
  if (!moved.runs.empty() && !std::exchange(is_touched_, true)) {
    const std::span<const std::uint32_t> before = still_of_ ? still_of_(band_) : std::span<const std::uint32_t>(still_);
    std::ranges::copy(before, whole_.begin());
  } else if (is_touched_ && !still_of_) {
    std::copy(still_.begin() + static_cast<std::ptrdiff_t>(word_of(next_)),
              still_.begin() + static_cast<std::ptrdiff_t>(word_of(end)),
              whole_.begin() + static_cast<std::ptrdiff_t>(word_of(next_)));
  }
  copy(moved, whole_);
  next_ = end;
  if (next_ < part_.end) return;
  end_part();
  if (next_ < lines_.end) begin_band();
}

void BandComposer::end_part() {
  if (still_of_ && !is_touched_) return;
  const std::size_t first = word_of(part_.first), count = word_of(part_.end) - first;
  const std::span<const std::uint32_t> still = std::span(still_).subspan(first, count);
  take_({band_, part_, is_touched_, still,
         is_touched_ ? std::span<const std::uint32_t>(whole_).subspan(first, count) : still});
}

// The layer's runs before line `end`, which are cut off from it.
BandComposer::Layer BandComposer::cut(Layer& layer, std::uint32_t end) const {
  const auto last = std::ranges::find_if(layer.runs, [&](const wire::Run& run) { return run.line >= end; });
  const Layer part{layer.runs.first(static_cast<std::size_t>(last - layer.runs.begin())), layer.pixels};
  for (const wire::Run& run : part.runs) layer.pixels += run.count * pixel_words_;
  layer.runs = layer.runs.subspan(part.runs.size());
  return part;
}

void BandComposer::copy(const Layer& layer, std::vector<std::uint32_t>& band) const {
  std::uint32_t* const picture = band.data() - std::size_t{bands_.lines_of(band_).first} * line_words_;
  compositor::copy_runs(layer.runs, layer.pixels, {bands_.width(), bands_.height(), pixel_words_}, picture);
}

// Of the current band's.
std::size_t BandComposer::word_of(std::uint32_t line) const {
  return (line - bands_.lines_of(band_).first) * line_words_;
}

}  // namespace mars::composer
