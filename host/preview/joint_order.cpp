#include "host/preview/joint_order.h"

#include <algorithm>

#include "host/content/animator/pose/figure.h"

namespace mars::preview {
namespace {

// The joints below `parent`, and each time those below them.
void add_below(const modeler::Model& model, std::size_t parent, std::vector<std::size_t>& order) {
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint) {
    if (model.joints[joint].parent != parent) continue;
    order.push_back(joint);
    add_below(model, joint, order);
  }
}

bool is_below(const modeler::Model& model, std::size_t joint, std::size_t top) {
  while (joint != modeler::kNone && joint != top) joint = model.joints[joint].parent;
  return joint == top;
}

}  // namespace

JointOrder::JointOrder(const animator::Film& film) : film_(film) {
  for (const bool still : {false, true})
    for (std::size_t actor = 0; actor < film.actors.size(); ++actor) {
      const animator::Actor& each = film.actors[actor];
      if (each.matrices.empty() && animator::Figure(film.models[each.model], each.motion).still() == still) add(actor);
    }
}

void JointOrder::add(std::size_t actor) {
  const modeler::Model& model = film_.model_of(actor);
  std::vector<std::size_t> order;
  add_below(model, modeler::kNone, order);
  for (const std::size_t joint : order)
    if (model.joints[joint].freedoms() > 0) joints_.push_back({actor, joint});
}

JointNumber JointOrder::beside(const std::optional<JointNumber>& from, int by) const {
  const auto count = static_cast<std::ptrdiff_t>(joints_.size());
  const std::ptrdiff_t at = from ? std::ranges::find(joints_, *from) - joints_.begin() : by > 0 ? -1 : 0;
  return joints_[static_cast<std::size_t>((at + by + count) % count)];
}

JointNumber JointOrder::above(const JointNumber& joint) const {
  const modeler::Model& model = film_.model_of(joint.actor);
  for (std::size_t up = model.joints[joint.joint].parent; up != modeler::kNone; up = model.joints[up].parent)
    if (model.joints[up].freedoms() > 0) return {joint.actor, up};
  return joint;
}

JointNumber JointOrder::below(const JointNumber& joint) const {
  const auto next = std::ranges::find(joints_, joint) + 1;
  if (next == joints_.end() || next->actor != joint.actor) return joint;
  const modeler::Model& model = film_.model_of(joint.actor);
  return is_below(model, next->joint, joint.joint) ? *next : joint;
}

}  // namespace mars::preview
