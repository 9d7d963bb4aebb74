// Encodes frames band by band. A band in which only the background shows is encoded once for all frames that show that
// background; other bands are restored, hashed and encoded: of what has not changed no pixel is touched.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/images/display_view.h"
#include "host/images/picture_bands.h"
#include "host/render/compositor/frame.h"

namespace mars::sinks {

struct HashedBand {
  images::EncodedBand encoded;
  std::string hash;  // of its pixels
};

struct EncodedFrame {
  std::vector<std::shared_ptr<const HashedBand>> bands;
  std::uint64_t encoded_bytes = 0;  // of pixels of the bands that were encoded for it

  std::string pixel_hash() const;
};

// Restores, hashes and encodes a band.
HashedBand encode_band(const images::PictureBands& bands, compositor::Frame& frame, std::size_t band);

// What shows frames of light, of PixelFormat::half or half_alpha, in files of PNG.
struct LightShown {
  std::shared_ptr<const images::DisplayView> view;
  std::function<double(std::uint32_t frame)> exposure;  // the same for all frames of an interval
};
// As encode_band, of light.
HashedBand encode_light(const LightShown& shown, const images::PictureBands& bands, compositor::Frame& frame,
                        std::size_t band);

class FrameEncoder {
 public:
  // `encode`: as encode_band; simulations have another, which only counts.
  using Encode =
      std::function<HashedBand(const images::PictureBands& bands, compositor::Frame& frame, std::size_t band)>;
  explicit FrameEncoder(const images::PictureBands& bands, Encode encode = encode_band)
      : bands_(bands), encode_(std::move(encode)) {}

  // From several threads at once, each with a frame of its own, which is finished.
  EncodedFrame encode(compositor::Frame& frame);
  // The pieces of its file, in order, which live as long as `frame` and `ends`.
  std::vector<std::span<const std::byte>> pieces(const EncodedFrame& frame, const images::PictureEnds& ends) const;
  images::PictureEnds ends_of(const EncodedFrame& frame, const images::FileFacts& facts) const;

 private:
  // Of a background: each band once it was needed.
  struct Kept {
    struct Band {
      std::mutex mutex;  // held while it is encoded; guards:
      std::shared_ptr<const HashedBand> encoded;
    };
    std::weak_ptr<const compositor::Background> background;
    std::vector<Band> bands;
  };

  std::shared_ptr<Kept> kept_for(const std::shared_ptr<const compositor::Background>& background);
  std::shared_ptr<const HashedBand> encode(compositor::Frame& frame, std::size_t band, EncodedFrame& encoded) const;

  const images::PictureBands bands_;
  const Encode encode_;
  std::mutex mutex_;  // guards:
  std::vector<std::shared_ptr<Kept>> kept_;
};

}  // namespace mars::sinks
