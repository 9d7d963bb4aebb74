// What the host does with image data (thesis 4.10): the CFB of an interval is kept as the saved background;
// a frame is that background with the MFB of its moving parts over it. One bit a block of pixels says which
// blocks were overwritten; only these are written back when a picture is used again, and of them only those that
// the new pixels do not fill. One Compositor serves one interval after another; frames come from a sink pool (or
// anywhere) and may pass from one compositor to another.
//
//   begin_interval with the plain background's pixel, then for its keyframe
//   begin_frame, paste_constant and paste_moving for each strip as it comes, finish_frame,
//   and for each other frame, in any order and several at a time,
//   begin_frame, paste_moving for every strip of it, finish_frame.
//
// A finished frame may still have stale blocks: who reads its pixels restores the lines that are read, or all, before.
//
// An interval of one frame needs no saved background: all its pixels go over the plain one by paste_moving.
//
// Runs and pixels, as words of pixels, are those of mars::wire::Strip. Runs that reach outside the picture, or pixels
// that are not as many as the runs count, throw Failure before anything is written.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "host/render/compositor/background.h"
#include "host/render/compositor/frame.h"
#include "node/wire/protocol.h"

namespace mars::compositor {

// What was done since it was asked last.
struct PastedCounts {
  std::uint64_t runs = 0;
  std::uint64_t bytes = 0;     // of their pixels; into the saved background and a frame: twice
  std::uint64_t restored = 0;  // bytes of background
};

class Compositor {
 public:
  // `block`: side of a flag's block in pixels, at least 1.
  Compositor(std::uint32_t width, std::uint32_t height, std::uint32_t block,
             wire::PixelFormat format = wire::PixelFormat::rgb8);
  Compositor(Compositor&&) = default;

  // The saved background is the plain background, whose pixel shows where nothing is drawn.
  void begin_interval(std::uint64_t plain);
  // Part of the CFB goes into the saved background, and into `keyframe` (unless nullptr), which was begun and
  // has all CFB so far.
  void paste_constant(std::span<const wire::Run> runs, std::span<const std::uint32_t> pixels, Frame* keyframe);

  // When `frame` is finished it will show the saved background wherever nothing is pasted. Until then the blocks that
  // were overwritten are stale, and where it showed another background those in which either has CFB.
  void begin_frame(Frame& frame) const;
  // Part of the MFB goes over it.
  void paste_moving(Frame& frame, std::span<const wire::Run> runs, std::span<const std::uint32_t> pixels);
  // A line of it as it is so far, in words of pixels: the saved background wherever nothing is pasted yet.
  void read_line(const Frame& frame, std::uint32_t line, std::span<std::uint32_t> words) const;
  // It is frame `number`; its `changed` says which blocks differ from the frame this compositor finished before.
  void finish_frame(Frame& frame, std::uint32_t number);

  // The frame, which is finished or not, has no stale block.
  void restore(Frame& frame);

  // Names the saved background, 0 while no CFB pixel was pasted: a frame with the same name costs least.
  std::uint64_t background_name() const { return name_; }

  PastedCounts take_counts() { return std::exchange(counts_, {}); }

 private:
  void count_pasted(std::span<const wire::Run> runs, std::span<const std::uint32_t> pixels);
  void check_runs(std::span<const wire::Run> runs, std::size_t words) const;
  void begin_background(std::uint64_t plain);
  void extend_background(std::uint32_t row, std::span<const wire::Run> runs);
  void refresh(Frame& frame, std::uint32_t row, std::span<const wire::Run> runs);
  void count_filled_lines(std::span<const wire::Run> runs);

  std::uint32_t width_;
  std::uint32_t height_;
  wire::PixelFormat format_;
  std::size_t pixel_words_;
  std::shared_ptr<Background> background_;
  std::uint64_t name_ = 0;
  BlockFlags last_overwritten_;               // by the frame finished last
  std::optional<std::uint32_t> last_number_;  // none: no frame of this interval yet
  BlockFlags fresh_;                          // extend_background's; empty between calls
  std::vector<std::uint32_t> filled_lines_;   // of each block of a row: count_filled_lines'
  PastedCounts counts_;
};

}  // namespace mars::compositor
