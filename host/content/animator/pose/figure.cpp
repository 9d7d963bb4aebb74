#include "host/content/animator/pose/figure.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "host/content/animator/pose/angles.h"
#include "host/content/document/fields.h"

namespace mars::animator {
namespace {

constexpr int kSteps = 64;  // in which the way beyond a key is searched for a limit

// How whole figures turn: freely, any number of times.
modeler::Joint whole_figure() {
  modeler::Joint joint;
  joint.limits.fill({-1e6, 1e6});
  return joint;
}

const modeler::Joint kFree = whole_figure();

// "turns about x and z only"
std::string freedoms_text(const modeler::Joint& joint) {
  std::string axes;
  for (int axis = 0; axis < 3; ++axis)
    if (joint.limits[axis].free()) axes += (axes.empty() ? "" : " and ") + std::string(1, "xyz"[axis]);
  return axes.empty() ? "does not turn" : "turns about " + axes + " only";
}

}  // namespace

const modeler::Joint& free_joint() { return kFree; }

std::uint32_t last_key(const FigureMotion& motion) {
  std::uint32_t last = 0;
  const auto look = [&](const auto& channel) {
    if (!channel.empty()) last = std::max(last, channel.back().frame);
  };
  look(motion.place);
  look(motion.turn);
  for (const auto& poses : motion.pose) look(poses);
  return last;
}

std::optional<std::string> broken_limit(const modeler::Joint& joint, const glm::dvec3& pose) {
  for (int axis = 0; axis < 3; ++axis) {
    const modeler::Limits& limits = joint.limits[axis];
    if (pose[axis] >= limits.lower && pose[axis] <= limits.upper) continue;
    if (!limits.free())
      return freedoms_text(joint) + "; its " + "xyz"[axis] + " axis is locked at " + document::shown(limits.lower) +
             ", not " + document::shown(pose[axis]);
    return "turns " + document::shown(pose[axis]) + " degrees about " + "xyz"[axis] + ", outside its limits " +
           document::shown(limits.lower) + " to " + document::shown(limits.upper);
  }
  return std::nullopt;
}

JointMotion::JointMotion(const modeler::Joint& joint, const Channel<glm::dvec3>& poses)
    : joint_(&joint), poses_(&poses) {}

glm::dmat3 JointMotion::at(std::uint32_t frame) {
  if (poses_->empty()) return modeler::orientation(*joint_, joint_->rest());
  const Stretch stretch = stretch_at(*poses_, frame);
  const glm::dvec3& from = (*poses_)[stretch.from].value;
  if (still(stretch)) return modeler::orientation(*joint_, from);
  return by_numbers(stretch) ? modeler::orientation(*joint_, pose_by_numbers(stretch)) : between(stretch);
}

bool JointMotion::still(const Stretch& stretch) const {
  return stretch.from == stretch.to || !moves_after(*poses_, stretch.from);
}

// One freedom, or a spline: the angles themselves go from key to key, so that whole turns are possible.
bool JointMotion::by_numbers(const Stretch& stretch) const {
  return joint_->freedoms() == 1 || (*poses_)[stretch.from].ease.spline;
}

glm::dvec3 JointMotion::pose_by_numbers(const Stretch& stretch) const {
  const Key<glm::dvec3>& from = (*poses_)[stretch.from];
  glm::dvec3 pose = from.ease.spline ? spline_at(*poses_, stretch)
                                     : from.value + stretch.part * ((*poses_)[stretch.to].value - from.value);
  for (int axis = 0; axis < 3; ++axis)
    pose[axis] = std::clamp(pose[axis], joint_->limits[axis].lower, joint_->limits[axis].upper);
  return pose;
}

glm::dmat3 JointMotion::between(const Stretch& stretch) {
  if (from_ != stretch.from) {
    from_ = stretch.from;
    start_ = modeler::orientation(*joint_, (*poses_)[stretch.from].value);
    turn_ = turn_between(start_, modeler::orientation(*joint_, (*poses_)[stretch.to].value));
    const Swing swing = swing_of((*poses_)[stretch.from].ease);
    first_part_ = swing.lowest < 0 ? allowed(stretch, 0, swing.lowest) : 0;
    last_part_ = swing.highest > 1 ? allowed(stretch, 1, swing.highest) : 1;
  }
  if (turn_.angle == 0) return start_;
  return turned(std::clamp(stretch.part, first_part_, last_part_));
}

glm::dmat3 JointMotion::turned(double part) const { return modeler::rotation(turn_.axis, part * turn_.angle) * start_; }

// From `key` (0 or 1) towards `wanted` parts of the way, as far as the limits allow.
double JointMotion::allowed(const Stretch& stretch, double key, double wanted) const {
  glm::dvec3 near = (*poses_)[key == 0 ? stretch.from : stretch.to].value;
  double good = key;
  for (int step = 1; step <= kSteps; ++step) {
    double part = key + (wanted - key) * step / kSteps;
    const glm::dvec3 pose = pose_of(*joint_, turned(part), near);
    if (largest_excess(*joint_, pose) <= kAngleRounding) {
      good = part;
      near = pose;
      continue;
    }
    for (int bit = 0; bit < 40; ++bit) {
      const double middle = (good + part) / 2;
      const bool fits = largest_excess(*joint_, pose_of(*joint_, turned(middle), near)) <= kAngleRounding;
      (fits ? good : part) = middle;
    }
    break;
  }
  return good;
}

glm::dvec3 JointMotion::pose_at(std::uint32_t frame) {
  if (poses_->empty()) return joint_->rest();
  const Stretch stretch = stretch_at(*poses_, frame);
  const glm::dvec3& from = (*poses_)[stretch.from].value;
  const glm::dvec3& to = (*poses_)[stretch.to].value;
  if (still(stretch)) return from;
  if (by_numbers(stretch)) return pose_by_numbers(stretch);
  return pose_of(*joint_, between(stretch), from + stretch.part * (to - from));
}

OwnFrame::OwnFrame(const FigureMotion& motion) : motion_(&motion), turn_(kFree, motion.turn) {}

modeler::Axes OwnFrame::at(std::uint32_t frame) { return {turn_.at(frame), value_at(motion_->place, frame)}; }

Figure::Figure(const modeler::Model& model, const FigureMotion& motion) : model_(&model), own_frame_(motion) {
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint) {
    turns_.push_back(JointMotion(model.joints[joint], motion.pose[joint]).at(0));
    if (motion.pose[joint].size() < 2) continue;
    keyed_.push_back(joint);
    motions_.emplace_back(model.joints[joint], motion.pose[joint]);
  }
  still_ = keyed_.empty() && motion.place.size() < 2 && motion.turn.size() < 2;
  frames_.resize(model.joints.size());
  moved_.resize(model.joints.size());
}

void Figure::turn_keyed_joints(std::uint32_t frame) {
  for (std::size_t i = 0; i < keyed_.size(); ++i) {
    const glm::dmat3 turn = motions_[i].at(frame);
    if (turn == turns_[keyed_[i]]) continue;
    turns_[keyed_[i]] = turn;
    moved_[keyed_[i]] = true;
  }
}

bool Figure::move_root(const modeler::Axes& root) {
  const bool moved = first_ || root.turn != root_.turn || root.place != root_.place;
  root_ = root;
  first_ = false;
  return moved;
}

bool Figure::move_to(std::uint32_t frame, const modeler::Axes& root) {
  std::fill(moved_.begin(), moved_.end(), char{false});
  turn_keyed_joints(frame);
  const bool root_moved = move_root(root);
  bool any = false;
  char* moved = moved_.data();
  modeler::Axes* frames = frames_.data();
  for (std::size_t number = 0; number < frames_.size(); ++number) {
    const modeler::Joint& joint = model_->joints[number];
    const bool rooted = joint.parent == modeler::kNone;
    if (rooted ? root_moved : moved[joint.parent]) moved[number] = true;
    if (!moved[number]) continue;
    any = true;
    const modeler::Axes& parent = rooted ? root_ : frames[joint.parent];
    frames[number] = {parent.turn * turns_[number], parent.turn * joint.place + parent.place};
  }
  return any;
}

}  // namespace mars::animator
