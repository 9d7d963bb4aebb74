// What the host does with image data (thesis 4.10): the CFB of an interval is kept as the saved background;
// a frame is that background with the MFB of its moving parts over it. One bit a block of pixels says which
// blocks a frame's moving parts overwrote; only these are written back before the frame's buffer is used
// again. One Compositor per interval being rendered at a time; frames come from a sink pool (or anywhere)
// and may pass from one compositor to another.
//
//   begin_interval, paste_constant for every strip, then for each frame in any order
//   begin_frame, paste_moving for every strip of it, finish_frame.
//
// Runs and pixels are those of node::Strip. Runs that reach outside the picture, or pixels that are not as
// many as the runs count, throw Failure before anything is written.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host/compositor/frame.h"
#include "node/protocol.h"

namespace mars::host {

class Compositor {
 public:
  // `block`: side of a flag's block in pixels, at least 1. `background`: the pixel where nothing is drawn.
  Compositor(std::uint32_t width, std::uint32_t height, std::uint32_t block, std::uint32_t background);

  // The saved background is the plain background again.
  void begin_interval();
  // Part of the CFB goes into the saved background; before the interval's first begin_frame.
  void paste_constant(std::span<const node::Run> runs, std::span<const std::uint32_t> pixels);

  // Makes `frame` show the saved background: writes its flagged blocks back, or all of it when it showed
  // another background.
  void begin_frame(Frame& frame, std::uint32_t number) const;
  // Part of the MFB goes over it.
  void paste_moving(Frame& frame, std::span<const node::Run> runs,
                    std::span<const std::uint32_t> pixels) const;
  // Tells which blocks changed since the frame this compositor finished before.
  void finish_frame(Frame& frame);

  std::span<const std::uint32_t> saved_background() const { return saved_; }
  // Names the saved background: a frame with the same name costs least to begin.
  std::uint64_t background_name() const { return name_; }

 private:
  void check_runs(std::span<const node::Run> runs, std::size_t pixels) const;

  std::uint32_t width_;
  std::uint32_t height_;
  std::uint32_t plain_;               // the background's pixel
  std::vector<std::uint32_t> saved_;  // the saved background: plain background and CFB
  std::uint64_t plain_name_;
  std::uint64_t name_;                        // plain_name_ while no CFB pixel was pasted
  BlockFlags last_overwritten_;               // by the frame finished last
  std::optional<std::uint32_t> last_number_;  // none: no frame of this interval yet
};

}  // namespace mars::host
