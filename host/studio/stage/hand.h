// One gesture: what was taken, and from where the mouse is, the step of the project that shows it. Angles stop at their
// limits; the way of the mouse beyond them has to be gone back.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/studio/stage/handles.h"
#include "host/studio/stage/mouse_way.h"
#include "host/studio/stage/picking.h"
#include "host/studio/stage/screen.h"

namespace mars::studio {

// A place in a joint's own frame that is to follow the mouse.
struct Held {
  std::size_t joint;  // which turns
  glm::dvec3 place;   // in its frame
};

// A joint that a ring of another turns, too.
struct TurnedAlong {
  std::string name;
  Posed posed;      // at the beginning
  glm::dvec3 pose;  // as it was shown last
};

class Hand {
 public:
  // `project` must outlive it; the camera stays as it is at the beginning.
  Hand(const Project& project, const Selection& selection, const Screen& screen, const glm::dvec2& mouse);
  Hand(const Project&&, auto&&...) = delete;

  void take(const Grip& grip, RingAxes axes = RingAxes::numbers);
  // The limb there turns about its joint; where that cannot turn, about the nearest above that can. False: none can.
  bool take(const Hit& hit);

  // The mouse is there now: the step that follows it, nothing where none does. `shift`: finely; for a control point,
  // along the nearest axis of its surface.
  std::optional<Json> follow(const glm::dvec2& mouse, bool shift);

 private:
  const std::string& actor_name() const;
  const std::string& joint_name() const;
  std::optional<Json> follow_ring();
  std::optional<Json> follow_limb();
  std::optional<Json> follow_place();
  std::optional<Json> follow_face();
  std::optional<Json> follow_point(bool along_axis);
  void take_along(std::size_t joint);
  Json turn_step(const glm::dvec3& turn) const;
  glm::dvec3 wound(const Posed& posed, const glm::dvec3& near) const;
  double turned_by(const glm::dvec2& before, const glm::dvec2& now) const;

  const Project& project_;
  Selection selection_;
  MouseWay mouse_;
  std::optional<Grip> grip_;
  std::optional<Held> held_;
  Posed posed_{};  // at the beginning
  std::vector<TurnedAlong> along_;
  // As chosen: a hinge turns by its number nevertheless.
  RingAxes axes_ = RingAxes::numbers;
  double wound_ = 0;           // degrees, of a ring
  glm::dvec3 pose_{0, 0, 0};   // as it was shown last
  glm::dvec3 place_{0, 0, 0};  // at the beginning: what is moved, in its own coordinates
  glm::dvec3 world_{0, 0, 0};  // the same place in the world
  modeler::Axes frame_{};      // of the segment
  modeler::Box sbb_{};
  wire::Matrix matrix_{};
};

// The pose nearest to `from`, within the limits, with which the place in the joint's frame comes nearest to the pixel:
// damped least squares (Levenberg 1944, Marquardt 1963) over the joint's free angles that do not twist the limb.
glm::dvec3 pose_towards(const Posed& joint, const glm::dvec3& place, const glm::dvec3& from, const Screen& screen,
                        const glm::dvec2& pixel);

}  // namespace mars::studio
