#include "host/content/animator/motion/body/posture.h"

namespace mars::motion {

Posture drawn_posture(const modeler::Model& model) {
  Posture posture;
  posture.pose.assign(model.joints.size(), glm::dvec3(0));
  return posture;
}

Posture posture_at(const modeler::Model& model, const animator::FigureMotion& motion, std::uint32_t frame) {
  Posture posture;
  posture.place = animator::value_at(motion.place, frame);
  posture.turn = animator::JointMotion(animator::free_joint(), motion.turn).pose_at(frame);
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint)
    posture.pose.push_back(animator::JointMotion(model.joints[joint], motion.pose[joint]).pose_at(frame));
  return posture;
}

glm::dmat3 actor_turn(const Posture& posture) { return modeler::orientation(animator::free_joint(), posture.turn); }

modeler::Axes socket_in(const modeler::Model& model, const Posture& posture, std::size_t joint) {
  const modeler::Joint& j = model.joints[joint];
  const modeler::Axes parent = j.parent == modeler::kNone ? modeler::Axes{actor_turn(posture), posture.place}
                                                          : frame_in(model, posture, j.parent);
  return {parent.turn, parent.turn * j.place + parent.place};
}

modeler::Axes frame_in(const modeler::Model& model, const Posture& posture, std::size_t joint) {
  const modeler::Axes socket = socket_in(model, posture, joint);
  return {socket.turn * modeler::orientation(model.joints[joint], posture.pose[joint]), socket.place};
}

}  // namespace mars::motion
