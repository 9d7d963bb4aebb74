#include "host/studio/stage/reach_hand.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <utility>

#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/attachments.h"
#include "host/studio/stage/hand_words.h"
#include "host/studio/stage/reach_place.h"

namespace mars::studio {
namespace {

motion::Posture posture_of(const Project& project, std::size_t actor) {
  animator::ActorState state = animator::state_at(project.film(), actor, project.frame());
  const auto& joints = project.film().model_of(actor).joints;
  for (std::size_t joint = 0; joint < joints.size(); ++joint)
    state.pose[joint] = animator::clamped(joints[joint], state.pose[joint]);
  return {state.place, state.turn, std::move(state.pose)};
}

glm::dvec3 in_frame(const modeler::Axes& frame, const glm::dvec3& place) {
  return glm::transpose(frame.turn) * (place - frame.place);
}

}  // namespace

ReachHand::ReachHand(const Project& project, const Selection& selection, std::vector<std::size_t> pins,
                     const glm::dvec3& place, const Screen& screen, const glm::dvec2& mouse)
    : project_(project),
      actor_(*selection.actor),
      pins_(std::move(pins)),
      grip_{Grip::What::plane},
      mouse_(screen, mouse),
      rest_(posture_of(project, actor_)),
      posture_(rest_),
      from_(place) {
  if (selection.joint) std::erase(pins_, *selection.joint);
  chain_ = reach_chain(project, selection, pins_);
  const modeler::Axes end = motion::frame_in(model(), rest_, chain_.end);
  held_ = selection.joint && ankle_of(model(), *selection.joint) ? end.place : place;
  pull_.held = in_frame(end, held_);
}

ReachHand::ReachHand(const Project& project, const Selection& selection, std::vector<std::size_t> pins,
                     const Grip& grip, const Screen& screen, const glm::dvec2& mouse)
    : ReachHand(project, selection, std::move(pins), reach_place(project, selection).value(), screen, mouse) {
  grip_ = grip;
}

const modeler::Model& ReachHand::model() const { return project_.film().model_of(actor_); }

std::optional<Json> ReachHand::follow(const glm::dvec2& mouse, bool shift) {
  mouse_.follow(mouse, shift);
  glm::dvec3 way(0);
  way[grip_.axis] = 1;
  const auto by = grip_.what == Grip::What::plane ? mouse_.across(from_) : mouse_.along(from_, way);
  if (!by) return std::nullopt;
  pull_.to = held_ + *by;
  motion::pull(model(), rest_, posture_, chain_, pull_, pins_);
  return step();
}

// All that is no more as it was.
Json ReachHand::step() const {
  std::map<std::string, glm::dvec3> pose;
  for (std::size_t joint = 0; joint < posture_.pose.size(); ++joint)
    if (posture_.pose[joint] != rest_.pose[joint]) pose[model().joints[joint].name] = posture_.pose[joint];
  if (project_.is_model()) return posed_model(pose);
  std::vector<std::string> settings;
  if (posture_.place != rest_.place) settings.push_back("place=" + shown_numbers(posture_.place));
  if (!settings.empty() || posture_.turn != rest_.turn) refuse_carried(project_, actor_);
  if (posture_.turn != rest_.turn) settings.push_back("turn=" + shown_numbers(posture_.turn));
  for (const auto& [joint, turns] : pose) settings.push_back(joint_setting(joint, turns));
  return pose_step(project_, project_.film().actors[actor_].name, settings);
}

std::vector<Handle> pin_handles(const Project& project, const Selection& selection,
                                const std::vector<std::size_t>& pins, const Screen& screen) {
  std::vector<Handle> handles;
  if (pins.empty()) return handles;
  const animator::ActorState state = animator::state_at(project.film(), *selection.actor, project.frame());
  for (const std::size_t joint : pins) {
    const auto pixel = state.joints.empty() ? std::nullopt : screen.pixel_of(state.joints[joint].place);
    if (!pixel) continue;
    const std::string& name = project.film().model_of(*selection.actor).joints[joint].name;
    handles.push_back({"pin:" + name, "pin", {*pixel}, "", name});
    handles.back().selected = selection.joint == joint;
  }
  return handles;
}

}  // namespace mars::studio
