// A gesture that moves the camera or a light, or what it aims at, or changes how wide it sees or shines.
#pragma once

#include <optional>

#include "host/studio/stage/marks.h"
#include "host/studio/stage/mouse_way.h"

namespace mars::studio {

class MarkHand {
 public:
  // `project` must outlive it. `grip` has a mark, which there is; `state` is as it stands at the beginning.
  MarkHand(const Project& project, const Grip& grip, const MarkState& state, const Screen& screen,
           const glm::dvec2& mouse)
      : project_(project), grip_(grip), state_(state), mouse_(screen, mouse) {}
  MarkHand(const Project&&, auto&&...) = delete;

  // The step that follows the mouse; nothing where none does.
  std::optional<Json> follow(const glm::dvec2& mouse, bool shift);

 private:
  Json step(const std::string& setting) const;
  std::optional<Json> offset_step(const glm::dvec3& to) const;
  std::optional<Json> moved() const;
  std::optional<Json> sized() const;

  const Project& project_;
  Grip grip_;
  MarkState state_;
  MouseWay mouse_;
};

}  // namespace mars::studio
