// The picture that is drawn now, as put together from what the host sent, and what pages receive of it.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "host/content/document/json_file.h"
#include "host/render/compositor/block_flags.h"
#include "host/render/pictures/reading.h"

namespace mars::studio {

using document::Json;

class DrawnPicture {
 public:
  DrawnPicture() = default;
  explicit DrawnPicture(const pictures::Begin& begin);

  // Blocks as large as this picture's.
  compositor::BlockFlags no_blocks() const { return {width_, height_, block_}; }
  bool there() const { return width_ > 0; }
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }

  // Flags in `changed` what it changes.
  void take(pictures::Picture update, std::span<compositor::BlockFlags* const> changed);
  void note_drawn(pictures::DrawnMessage drawn);

  // Pixels of rectangles, as in ViewPicture.
  std::vector<std::uint32_t> pixels_of(std::span<const pictures::Rect> rects) const {
    return pictures::cut_opaque(pixels_, width_, rects);
  }
  // The message `drawn`, with the blocks that are sent with it.
  Json describe(const compositor::BlockFlags& flagged) const;

 private:
  Json nodes() const;
  Json edge_boxes() const;
  compositor::BlockFlags blocks_with(pictures::Mark mark) const;

  std::uint32_t width_ = 0, height_ = 0, block_ = 1;
  pictures::PictureHead head_{};
  std::vector<std::uint32_t> pixels_;  // with marks in their highest bytes
  std::vector<pictures::Line> lines_;
  std::map<std::uint32_t, pictures::DrawnMessage> drawn_;  // the last frames that are whole
};

}  // namespace mars::studio
