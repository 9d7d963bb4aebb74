// Where whole actors and single joints stand at a frame, by their own keys or carried by others: of each actor on the
// way only the joints that lead there are turned. The one place that knows what an attachment means:
//   actor's frame = carrier's frame (place, turn): turn = F.turn O.turn, place = F.turn O.place + F.place,
// where F is the joint's frame and O the attachment's own; for a figure of its own, Figure computes the same numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "host/content/animator/pose/film.h"

namespace mars::animator {

class JointFrames {
 public:
  explicit JointFrames(const Film& film) : film_(film) {}  // must outlive it
  explicit JointFrames(const Film&&) = delete;

  // Of an actor that no matrices move.
  modeler::Axes root_of(std::size_t actor, std::uint32_t frame);
  // Of one of its joints; kNone: of the actor itself.
  modeler::Axes frame_of(std::size_t actor, std::size_t joint, std::uint32_t frame);

 private:
  modeler::Axes own_frame(std::size_t actor, std::uint32_t frame);
  modeler::Axes in_figure(const modeler::Axes& root, std::size_t actor, std::size_t joint, std::uint32_t frame);
  JointMotion& motion_of(std::size_t actor, std::size_t joint);

  const Film& film_;
  // Made when they are asked for.
  std::map<std::size_t, OwnFrame> own_;
  std::map<std::pair<std::size_t, std::size_t>, JointMotion> joints_;
};

// What stands in the frame.
modeler::Axes within(const modeler::Axes& frame, const modeler::Axes& inner);
// So that within(frame, inner) is `outer`; `frame` has no skew.
modeler::Axes seen_from(const modeler::Axes& frame, const modeler::Axes& outer);

modeler::Axes axes_of(const Attachment& attachment);

}  // namespace mars::animator
