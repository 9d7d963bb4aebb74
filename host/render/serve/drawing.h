// Which pictures nodes draw: each node does what it is given in turn.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "host/render/compositor/frame.h"
#include "node/wire/protocol.h"

namespace mars::serve {

// One that nodes draw.
struct Picture {
  std::uint32_t view = 0;
  std::uint32_t asked = 0;  // its number for the studio
  wire::FrameKind kind = wire::FrameKind::keyframe;
  compositor::Frame* frame = nullptr;  // where it is put together; nullptr: it is needed no more
  double begun = 0;
  std::size_t nodes_left = 0;  // that have not sent their last strip of it
};

class Drawing {
 public:
  explicit Drawing(std::size_t nodes) : given_(nodes) {}

  // A picture is given to one node, or to all; its number, which ascends.
  std::uint32_t give(int node, Picture picture);
  std::uint32_t give_to_all(Picture picture);

  // The node that is idle and whose turn it is; none: all draw.
  std::optional<int> take_idle();
  bool all_idle() const { return pictures_.empty(); }
  // Keyframes that are being drawn: of this view, of others.
  struct Keyframes {
    std::size_t of_view = 0, others = 0;
  };
  Keyframes keyframes(std::uint32_t view) const;

  // Of a node's strip; nullptr: it was not given that, or has ended it.
  const Picture* find(int node, std::uint32_t number) const;
  // The node's last strip of it came. The picture, if no more of it is to come from any node.
  std::optional<Picture> end(int node, std::uint32_t number);

  // What the node draws, or is about to.
  std::optional<std::uint32_t> drawn_by(int node) const;

  // Calls visit(picture) for those of the view that are wanted.
  template <typename Visit>
  void for_wanted(std::uint32_t view, Visit visit) {
    for (auto& [number, picture] : pictures_)
      if (picture.view == view && picture.frame != nullptr) visit(picture);
  }

 private:
  std::uint32_t last_ = 0;
  std::size_t turn_ = 0;                          // the node that is asked next whether it is idle
  std::map<std::uint32_t, Picture> pictures_;     // by number
  std::vector<std::deque<std::uint32_t>> given_;  // to each node, what it has not ended
};

}  // namespace mars::serve
