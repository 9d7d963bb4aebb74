// Frames of one unit put together from the strips of its cube's nodes, whatever the order of their arrival:
// CFB pixels go into the saved background at once; a frame is whole when the last strips of all who draw it
// are here, and can be composed when the background is.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "hal/cube.h"
#include "host/compositor/compositor.h"
#include "host/farm/schedule.h"
#include "host/farm/strip_message.h"

namespace mars::host {

class Assembly {
 public:
  Assembly(const Unit& unit, const hal::Cube& cube, Compositor compositor);

  // Whether strips of `frame` are still to come.
  bool wants(std::uint32_t frame) const;
  // A strip of a frame it wants.
  void receive(StripMessage strip);

  // Whether a frame can be composed, and which background it will show.
  bool ready() const { return background_parts_ == 0 && !whole_.empty(); }
  std::uint64_t background_name() const { return compositor_.background_name(); }

  struct Composed {
    std::uint32_t frame;
    node::FrameKind kind;
    std::vector<std::int32_t> nodes;            // that drew it
    std::vector<std::vector<std::byte>> bytes;  // of its strips, no longer needed
  };
  // Composes the next ready frame into `frame`.
  Composed compose(Frame& frame);

  bool done() const { return frames_left_ == 0; }
  // The compositor, for another unit.
  Compositor release() { return std::move(compositor_); }
  const hal::Cube& cube() const { return cube_; }

 private:
  // A frame's strips so far.
  struct Parts {
    std::vector<StripMessage> strips;
    int artists_left = 0;
  };

  hal::Cube cube_;
  std::uint32_t keyframe_;
  Compositor compositor_;
  std::map<std::uint32_t, Parts> parts_;
  std::deque<std::uint32_t> whole_;
  int background_parts_;  // nodes whose CFB is still to come
  std::size_t frames_left_;
};

}  // namespace mars::host
