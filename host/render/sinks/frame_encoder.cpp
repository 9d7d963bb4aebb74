#include "host/render/sinks/frame_encoder.h"

#include "host/images/encode_bands.h"
#include "host/render/sinks/pixel_hash.h"

namespace mars::sinks {

HashedBand encode_band(const images::PictureBands& bands, compositor::Frame& frame, std::size_t band) {
  const images::Lines lines = bands.lines_of(band);
  frame.restore({lines.first, lines.end});
  const images::FilePixels pixels(bands, bands.part_of(frame.pixels, band));
  return {images::encode_band(bands, band, pixels.words()), hash_of_band(pixels.words())};
}

HashedBand encode_light(const LightShown& shown, const images::PictureBands& bands, compositor::Frame& frame,
                        std::size_t band) {
  const images::Lines lines = bands.lines_of(band);
  frame.restore({lines.first, lines.end});
  const std::size_t line = bands.width() * wire::pixel_words(wire::PixelFormat::half);
  const auto light = std::span<const std::uint32_t>(frame.pixels).subspan(lines.first * line, lines.count() * line);
  const auto exposure = static_cast<float>(shown.exposure(frame.number));
  const std::vector<std::uint32_t> pixels =
      images::shown_pixels(*shown.view, light, exposure, images::facts_of(bands.format()).pixels);
  return {images::encode_band(bands, band, pixels), hash_of_band(pixels)};
}

std::string EncodedFrame::pixel_hash() const {
  std::vector<std::string> hashes;
  for (const auto& band : bands) hashes.push_back(band->hash);
  return hash_of_bands(hashes);
}

EncodedFrame FrameEncoder::encode(compositor::Frame& frame) {
  const std::shared_ptr<Kept> kept = kept_for(frame.shown);
  EncodedFrame encoded;
  for (std::size_t band = 0; band < bands_.count(); ++band) {
    const images::Lines lines = bands_.lines_of(band);
    if (kept == nullptr || !frame.shows_background({lines.first, lines.end})) {
      encoded.bands.push_back(encode(frame, band, encoded));
      continue;
    }
    Kept::Band& of_background = kept->bands[band];
    const std::lock_guard lock(of_background.mutex);
    if (!of_background.encoded) of_background.encoded = encode(frame, band, encoded);
    encoded.bands.push_back(of_background.encoded);
  }
  return encoded;
}

std::shared_ptr<const HashedBand> FrameEncoder::encode(compositor::Frame& frame, std::size_t band,
                                                       EncodedFrame& encoded) const {
  encoded.encoded_bytes += bands_.words_of(bands_.lines_of(band)) * sizeof(std::uint32_t);
  return std::make_shared<HashedBand>(encode_(bands_, frame, band));
}

std::shared_ptr<FrameEncoder::Kept> FrameEncoder::kept_for(
    const std::shared_ptr<const compositor::Background>& background) {
  if (background == nullptr) return nullptr;
  const std::lock_guard lock(mutex_);
  std::erase_if(kept_, [](const auto& kept) { return kept->background.expired(); });
  for (const auto& kept : kept_)
    if (kept->background.lock() == background) return kept;
  auto kept = std::make_shared<Kept>();
  kept->background = background;
  kept->bands = std::vector<Kept::Band>(bands_.count());
  return kept_.emplace_back(std::move(kept));
}

images::PictureEnds FrameEncoder::ends_of(const EncodedFrame& frame, const images::FileFacts& facts) const {
  std::vector<images::BandPart> parts;
  for (const auto& band : frame.bands) parts.push_back(band->encoded.part());
  return images::ends_of(bands_, parts, facts);
}

std::vector<std::span<const std::byte>> FrameEncoder::pieces(const EncodedFrame& frame,
                                                             const images::PictureEnds& ends) const {
  std::vector<std::span<const std::byte>> pieces{ends.before};
  for (const auto& band : frame.bands) pieces.emplace_back(band->encoded.bytes);
  pieces.emplace_back(ends.after);
  return pieces;
}

}  // namespace mars::sinks
