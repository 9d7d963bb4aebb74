// A page's message about one view: what it is to show.
#pragma once

#include <cstdint>
#include <optional>

#include "host/studio/stage/eye.h"
#include "host/studio/stage/ghosts.h"
#include "host/studio/stage/handles.h"
#include "host/studio/stage/line_pictures.h"

namespace mars::studio {

struct ViewMessage {
  std::uint32_t number = 0, width = 0, height = 0;
  From from = From::free;
  std::optional<preview::Orbit> orbit{};  // none: the studio chooses, or it is the film's camera
  LineLook look{};
  Tool tool = Tool::none;
  RingAxes axes = RingAxes::numbers;
  GhostFrames ghosts{};
  bool marks = false;
};

// Both throw Failure where it makes no sense.
ViewMessage read_view(const Json& message);
std::uint32_t view_number_in(const Json& message);

}  // namespace mars::studio
