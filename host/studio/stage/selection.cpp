#include "host/studio/stage/selection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "host/studio/stage/marks.h"

namespace mars::studio {
namespace {

constexpr double kJointReach = 12;  // pixels from a joint that is picked where no surface is

Selection nearest_joint(const Project& project, const Screen& screen, const glm::dvec2& pixel) {
  Selection nearest;
  double least = kJointReach;
  const std::size_t actors = project.is_model() ? 1 : project.film().actors.size();
  for (std::size_t actor = 0; actor < actors; ++actor) {
    const animator::ActorState state = animator::state_at(project.film(), actor, project.frame());
    for (std::size_t joint = 0; joint < state.joints.size(); ++joint) {
      const auto at = screen.pixel_of(state.joints[joint].place);
      if (!at || glm::length(*at - pixel) > least) continue;
      least = glm::length(*at - pixel);
      nearest = {actor, joint};
    }
  }
  return nearest;
}

}  // namespace

Selection selection_of(const Project& project, const Named& named) {
  Selection selection;
  if (const auto mark = named.thing ? mark_named(*named.thing) : std::nullopt; mark && there_is(project, *mark))
    selection.mark = mark;
  if (!named.actor) return selection;
  const animator::Film& film = project.film();
  const auto actor = std::find_if(film.actors.begin(), film.actors.end(),
                                  [&](const animator::Actor& each) { return each.name == named.actor; });
  if (actor == film.actors.end()) return selection;
  selection.actor = actor - film.actors.begin();
  const auto& joints = film.models[actor->model].joints;
  for (std::size_t joint = 0; joint < joints.size(); ++joint)
    if (joints[joint].name == named.joint)
      selection.joint = joint;
    else if (std::ranges::find(named.more, joints[joint].name) != named.more.end())
      selection.more.push_back(joint);
  if (!selection.joint) selection.more.clear();
  return selection;
}

Named names_of(const Project& project, const Selection& selection) {
  Named named;
  if (selection.mark) named.thing = name_of(*selection.mark);
  if (!selection.actor) return named;
  const animator::Actor& actor = project.film().actors[*selection.actor];
  const auto& joints = project.film().models[actor.model].joints;
  named.actor = actor.name;
  if (selection.joint) named.joint = joints[*selection.joint].name;
  for (const std::size_t joint : selection.more) named.more.push_back(joints[joint].name);
  return named;
}

void put_names(const Project& project, const Selection& selection, Json& message) {
  const Named named = names_of(project, selection);
  message["actor"] = named.actor ? Json(*named.actor) : Json(nullptr);
  message["joint"] = named.joint ? Json(*named.joint) : Json(nullptr);
  message["thing"] = named.thing ? Json(*named.thing) : Json(nullptr);
}

std::string text_of(const Project& project, const Selection& selection) {
  const Named named = names_of(project, selection);
  if (!named.joint) return named.thing ? *named.thing : named.actor.value_or("");
  const auto posed = studio::posed(project, selection);
  std::string text = *named.joint;
  for (int axis = 0; posed && axis < 3; ++axis)
    if (posed->joint->limits[static_cast<std::size_t>(axis)].free())
      text += std::string(" ") + "xyz"[axis] + " " + document::shown(std::round(posed->pose[axis] * 10) / 10);
  return text;
}

std::size_t turning_joint(const modeler::Model& model, std::size_t joint) {
  while (joint != modeler::kNone && model.joints[joint].freedoms() == 0) joint = model.joints[joint].parent;
  return joint;
}

Selection clicked(const Project& project, const Selection& picked) {
  if (project.is_model() || !picked.joint) return picked;
  const std::size_t joint = turning_joint(project.film().model_of(*picked.actor), *picked.joint);
  return {picked.actor, joint == modeler::kNone ? std::nullopt : std::optional(joint)};
}

Picked pick(const Project& project, const Moments& moments, const Screen& screen, const glm::dvec2& pixel) {
  const auto& owners = moments.owners();
  const auto counts = [&](std::size_t segment) { return !project.is_model() || owners[segment].actor == 0; };
  if (const auto hit = first_hit(moments, screen.ray_through(pixel), counts)) {
    const auto [actor, joint] = owners[hit->segment];
    const auto& segment = *project.film().model_of(actor).joints[joint].segment;
    return {{actor, hit->bone ? segment.bones[*hit->bone].joint : joint}, hit};
  }
  return {nearest_joint(project, screen, pixel), std::nullopt};
}

}  // namespace mars::studio
