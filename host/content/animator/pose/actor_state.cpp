#include "host/content/animator/pose/actor_state.h"

#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/attachments.h"
#include "host/content/animator/pose/joint_frames.h"

namespace mars::animator {
namespace {

// By matrices: each holds until the next.
void place_by_matrices(const Actor& actor, const modeler::Model& model, std::uint32_t frame, ActorState& state) {
  const auto held = [&](std::size_t joint) {
    const Channel<modeler::Axes>& matrices = actor.matrices[joint];
    return matrices[stretch_at(matrices, frame).from].value;
  };
  for (std::size_t number = 0; number < model.joints.size(); ++number) {
    const modeler::Joint& joint = model.joints[number];
    if (!joint.segment) continue;
    state.segments[number] = modeler::t_matrix(held(number), joint.segment->sbb);
    for (const modeler::Bone& bone : joint.segment->bones)
      state.bones[number].push_back(
          modeler::bone_matrix(modeler::joint_frame(held(bone.joint), model.joints[bone.joint]), bone, joint));
  }
}

void place_by_keys(const Film& film, std::size_t actor_number, std::uint32_t frame, ActorState& state) {
  const Actor& actor = film.actors[actor_number];
  const modeler::Model& model = film.models[actor.model];
  state.root = JointFrames(film).root_of(actor_number, frame);
  state.place = value_at(actor.motion.place, frame);
  state.turn = JointMotion(free_joint(), actor.motion.turn).pose_at(frame);
  if (attachment_at(actor, frame)) {
    state.place = state.root.place;
    state.turn = pose_of(free_joint(), state.root.turn, state.turn);
  }
  Figure figure(model, actor.motion);
  figure.move_to(frame, state.root);
  for (std::size_t number = 0; number < model.joints.size(); ++number) {
    const modeler::Joint& joint = model.joints[number];
    state.pose.push_back(JointMotion(joint, actor.motion.pose[number]).pose_at(frame));
    state.joints.push_back(figure.frame_of(number));
    if (!joint.segment) continue;
    state.segments[number] =
        modeler::t_matrix(modeler::segment_frame(figure.frame_of(number), joint), joint.segment->sbb);
    for (const modeler::Bone& bone : joint.segment->bones)
      state.bones[number].push_back(modeler::bone_matrix(figure.frame_of(bone.joint), bone, joint));
  }
}

}  // namespace

ActorState state_at(const Film& film, std::size_t number, std::uint32_t frame) {
  const Actor& actor = film.actors.at(number);
  const modeler::Model& model = film.models[actor.model];
  ActorState state{};
  state.segments.resize(model.joints.size());
  state.bones.resize(model.joints.size());
  actor.matrices.empty() ? place_by_keys(film, number, frame, state) : place_by_matrices(actor, model, frame, state);
  return state;
}

}  // namespace mars::animator
