// A gesture that moves the camera or a light, or what it aims at, or changes how wide it sees or shines.
#pragma once

#include <optional>

#include "host/studio/stage/marks.h"
#include "host/studio/stage/mouse_way.h"

namespace mars::studio {

class MarkHand {
 public:
  // `grip` has a mark, which there is; `state` is as it stands at the beginning.
  MarkHand(const Grip& grip, const MarkState& state, const Screen& screen, const glm::dvec2& mouse)
      : grip_(grip), state_(state), mouse_(screen, mouse) {}

  // The step that follows the mouse; nothing where none does.
  std::optional<Json> follow(const glm::dvec2& mouse, bool shift);

 private:
  Json step() const;
  std::optional<Json> moved() const;
  std::optional<Json> sized() const;

  Grip grip_;
  MarkState state_;
  MouseWay mouse_;
};

}  // namespace mars::studio
