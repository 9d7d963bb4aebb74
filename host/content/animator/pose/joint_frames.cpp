#include "host/content/animator/pose/joint_frames.h"

#include <glm/matrix.hpp>

#include "host/content/animator/pose/attachments.h"

namespace mars::animator {

modeler::Axes within(const modeler::Axes& frame, const modeler::Axes& inner) {
  return {frame.turn * inner.turn, frame.turn * inner.place + frame.place};
}

modeler::Axes seen_from(const modeler::Axes& frame, const modeler::Axes& outer) {
  const glm::dmat3 back = glm::transpose(frame.turn);
  return {back * outer.turn, back * (outer.place - frame.place)};
}

modeler::Axes axes_of(const Attachment& attachment) {
  return {modeler::orientation(free_joint(), attachment.turn), attachment.place};
}

modeler::Axes JointFrames::own_frame(std::size_t actor, std::uint32_t frame) {
  return own_.try_emplace(actor, film_.actors[actor].motion).first->second.at(frame);
}

JointMotion& JointFrames::motion_of(std::size_t actor, std::size_t joint) {
  const Actor& one = film_.actors[actor];
  return joints_.try_emplace({actor, joint}, film_.models[one.model].joints[joint], one.motion.pose[joint])
      .first->second;
}

modeler::Axes JointFrames::in_figure(const modeler::Axes& root, std::size_t actor, std::size_t joint,
                                     std::uint32_t frame) {
  const auto& joints = film_.model_of(actor).joints;
  std::vector<std::size_t> way;
  for (std::size_t at = joint; at != modeler::kNone; at = joints[at].parent) way.push_back(at);
  modeler::Axes axes = root;
  for (auto at = way.rbegin(); at != way.rend(); ++at)
    axes = within(axes, {motion_of(actor, *at).at(frame), joints[*at].place});
  return axes;
}

modeler::Axes JointFrames::root_of(std::size_t actor, std::uint32_t frame) {
  const std::vector<std::size_t> chain = chain_at(film_.actors, actor, frame);
  modeler::Axes root = own_frame(chain.back(), frame);
  for (std::size_t i = chain.size() - 1; i-- > 0;) {
    const Attachment& attachment = *attachment_at(film_.actors[chain[i]], frame);
    root = within(in_figure(root, chain[i + 1], attachment.joint, frame), axes_of(attachment));
  }
  return root;
}

modeler::Axes JointFrames::frame_of(std::size_t actor, std::size_t joint, std::uint32_t frame) {
  return in_figure(root_of(actor, frame), actor, joint, frame);
}

}  // namespace mars::animator
