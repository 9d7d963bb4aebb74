#include "host/studio/stage/reach_place.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/pose/attachments.h"
#include "host/content/modeler/frames.h"

namespace mars::studio {
namespace {

bool is_on(const modeler::Model& model, std::size_t joint, std::size_t above) {
  while (joint != above && joint != modeler::kNone) joint = model.joints[joint].parent;
  return joint == above;
}

glm::dvec3 end_of_segment(const modeler::Joint& joint) {
  const modeler::Box& sbb = joint.segment->sbb;
  glm::dvec3 farthest(0);
  for (int axis = 0; axis < 3; ++axis)
    for (const double at : {sbb.min[axis], sbb.max[axis]}) {
      glm::dvec3 face = 0.5 * (sbb.min + sbb.max);
      face[axis] = at;
      face = modeler::segment_axes(joint) * face;
      if (glm::length(face) > glm::length(farthest)) farthest = face;
    }
  return farthest;
}

glm::dvec3 middle_of_children(const modeler::Model& model, std::size_t parent) {
  glm::dvec3 sum(0);
  int count = 0;
  for (const modeler::Joint& joint : model.joints)
    if (joint.parent == parent && joint.place != glm::dvec3(0)) {
      sum += joint.place;
      ++count;
    }
  return count == 0 ? sum : sum / double(count);
}

}  // namespace

std::optional<std::size_t> ankle_of(const modeler::Model& model, std::size_t joint) {
  for (const modeler::Side side : {modeler::Side::left, modeler::Side::right}) {
    const std::size_t ankle = model.limbs.of(modeler::Limb::ankle, side);
    if (ankle != modeler::kNone && is_on(model, joint, ankle)) return ankle;
  }
  return std::nullopt;
}

// A foot is pulled at its ankle: pulled elsewhere it would rather turn than bend the knee. On pinned feet the whole
// figure goes along. A model, and who is carried, has no place of its own.
motion::Chain reach_chain(const Project& project, const Selection& selection, const std::vector<std::size_t>& pins) {
  const modeler::Model& model = project.film().model_of(*selection.actor);
  const bool stays =
      project.is_model() || animator::attachment_at(project.film().actors[*selection.actor], project.frame());
  const bool stands = std::ranges::any_of(pins, [&](std::size_t pin) { return ankle_of(model, pin).has_value(); });
  motion::Chain chain{0, {}, {}, true};
  if (selection.joint)
    chain = motion::chain_of(model, ankle_of(model, *selection.joint).value_or(*selection.joint),
                             stands && !stays ? motion::Extent::body : motion::Extent::limb);
  if (stays) chain.moves_actor = false;
  return chain;
}

bool can_reach(const Project& project, const Selection& selection) {
  if (!selection.actor || !project.film().actors[*selection.actor].matrices.empty()) return false;
  if (project.film().model_of(*selection.actor).joints.empty()) return false;
  const motion::Chain chain = reach_chain(project, selection, {});
  return chain.moves_actor || !chain.joints.empty();
}

std::optional<glm::dvec3> reach_place(const Project& project, const Selection& selection) {
  if (!can_reach(project, selection)) return std::nullopt;
  const animator::ActorState state = animator::state_at(project.film(), *selection.actor, project.frame());
  if (!selection.joint) return state.place;
  const modeler::Axes& frame = state.joints[*selection.joint];
  return frame.turn * end_of(project.film().model_of(*selection.actor), *selection.joint) + frame.place;
}

glm::dvec3 end_of(const modeler::Model& model, std::size_t number) {
  const modeler::Joint& joint = model.joints[number];
  if (joint.parent == modeler::kNone) return glm::dvec3(0);
  return joint.segment && joint.segment->bones.empty() ? end_of_segment(joint) : middle_of_children(model, number);
}

}  // namespace mars::studio
