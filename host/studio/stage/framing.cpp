#include "host/studio/stage/framing.h"

#include "host/content/animator/pose/actor_state.h"
#include "host/studio/stage/marks.h"

namespace mars::studio {
namespace {

constexpr double kMarkRadius = 0.25;  // of the subject's: about a symbol, or a joint that carries nothing

preview::Ball ball_at(const glm::dvec3& place, const Moments& moments) {
  return {place, kMarkRadius * moments.subject().radius};
}

bool is_below(const modeler::Model& model, std::size_t joint, std::size_t ancestor) {
  while (joint != modeler::kNone && joint != ancestor) joint = model.joints[joint].parent;
  return joint == ancestor;
}

}  // namespace

preview::Ball ball_of(const Project& project, const Moments& moments, const Selection& selection) {
  if (selection.mark) {
    const MarkState state = state_of(project, moments, *selection.mark);
    return state.far ? moments.subject() : ball_at(state.place, moments);
  }
  if (!selection.actor || !moments.show_the_film()) return moments.subject();
  const std::size_t actor = *selection.actor;
  if (!selection.joint)
    return moments.ball_of([&](const Owner& owner) { return owner.actor == actor; }).value_or(moments.subject());
  const std::size_t joint = *selection.joint;
  const modeler::Model& model = project.film().models[project.film().actors[actor].model];
  const auto counts = [&](const Owner& owner) {
    if (owner.actor != actor) return false;
    return model.joints[joint].segment ? owner.joint == joint : is_below(model, owner.joint, joint);
  };
  if (const auto ball = moments.ball_of(counts)) return *ball;
  return ball_at(animator::state_at(project.film(), actor, project.frame()).joints[joint].place, moments);
}

}  // namespace mars::studio
