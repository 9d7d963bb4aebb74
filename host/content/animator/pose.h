// Posing: a figure, or the camera, set at one frame by what a person wants of its parts; the limits of joints are
// held. The thesis's quadruple (model, segment, axis, angle) is one of these settings.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "host/content/animator/keys.h"

namespace mars::animator {

// One part and its new numbers; what is none stays as it is at the frame.
struct PartSetting {
  std::string part;  // "place", "fov"; a joint is "/" and its name
  std::array<std::optional<double>, 3> numbers;

  // "elbow.y=90", "elbow=0,90,0", "place.z=1.5", "fov=30", of a part as a person names it. Throws where it is none of
  // these.
  static PartSetting read(const std::string& text, const Thing& thing);
};

// Sets the thing `name` (an actor, or "camera") at the frame, with an ease from there if given. A part without keys
// also gets one at frame 0, as it was, so that it moves from there.
Remarks pose(document::Json& film, const Film& meaning, const std::string& name, std::span<const PartSetting> settings,
             std::uint32_t frame, const std::optional<Ease>& ease, Beyond beyond);
Remarks pose(document::Json& film, const Film& meaning, const std::string& name, std::span<const std::string> settings,
             std::uint32_t frame, const std::optional<Ease>& ease, Beyond beyond);

}  // namespace mars::animator
