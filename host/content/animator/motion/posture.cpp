#include "host/content/animator/motion/posture.h"

namespace mars::host {

Posture drawn_posture(const Model& model) {
  Posture posture;
  posture.pose.assign(model.joints.size(), glm::dvec3(0));
  return posture;
}

Posture posture_at(const Model& model, const FigureMotion& motion, std::uint32_t frame) {
  Posture posture;
  posture.place = value_at(motion.place, frame);
  posture.turn = JointMotion(free_joint(), motion.turn).pose_at(frame);
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint)
    posture.pose.push_back(JointMotion(model.joints[joint], motion.pose[joint]).pose_at(frame));
  return posture;
}

glm::dmat3 actor_turn(const Posture& posture) { return orientation(free_joint(), posture.turn); }

Axes socket_in(const Model& model, const Posture& posture, std::size_t joint) {
  const Joint& j = model.joints[joint];
  const Axes parent =
      j.parent == kNone ? Axes{actor_turn(posture), posture.place} : frame_in(model, posture, j.parent);
  return {parent.turn, parent.turn * j.place + parent.place};
}

Axes frame_in(const Model& model, const Posture& posture, std::size_t joint) {
  const Axes socket = socket_in(model, posture, joint);
  return {socket.turn * orientation(model.joints[joint], posture.pose[joint]), socket.place};
}

}  // namespace mars::host
