// A gesture that pulls a figure at one place: the limb there turns within its limits, or the figure moves, by inverse
// kinematics (host/content/animator/motion/body/pull.h). Pinned joints stay where they were when it began.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/content/animator/motion/body/pull.h"
#include "host/studio/stage/handles.h"
#include "host/studio/stage/mouse_way.h"

namespace mars::studio {

// By names, for the film may change under it.
struct Pin {
  std::string actor, joint;

  auto operator<=>(const Pin&) const = default;
};

class ReachHand {
 public:
  // `project` must outlive it. It can reach; `pins` are joints of its actor. Taken where the joint's surface is, across
  // the view; or at an arrow or point of the joint's end.
  ReachHand(const Project& project, const Selection& selection, std::vector<std::size_t> pins, const glm::dvec3& place,
            const Screen& screen, const glm::dvec2& mouse);
  ReachHand(const Project& project, const Selection& selection, std::vector<std::size_t> pins, const Grip& grip,
            const Screen& screen, const glm::dvec2& mouse);
  ReachHand(const Project&&, auto&&...) = delete;

  // The step that follows the mouse; nothing where none does.
  std::optional<Json> follow(const glm::dvec2& mouse, bool shift);

 private:
  const modeler::Model& model() const;
  Json step() const;

  const Project& project_;
  std::size_t actor_;
  std::vector<std::size_t> pins_;
  Grip grip_;
  MouseWay mouse_;
  motion::Posture rest_, posture_;  // at the beginning; as it was shown last
  motion::Chain chain_;
  motion::Pull pull_;
  glm::dvec3 from_, held_;  // in the world at the beginning: where the mouse took it, and what is pulled
};

std::vector<Handle> pin_handles(const Project& project, const Selection& selection,
                                const std::vector<std::size_t>& pins, const Screen& screen);

}  // namespace mars::studio
