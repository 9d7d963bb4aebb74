#include "host/preview/pose_under_way.h"

#include <algorithm>
#include <set>

#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/attachments.h"
#include "host/content/animator/keys/set_key.h"

namespace mars::preview {
namespace {

const modeler::Joint& joint_of(const animator::Film& film, const JointNumber& number) {
  return film.model_of(number.actor).joints[number.joint];
}

std::pair<std::string, std::string> names_of(const animator::Film& film, const JointNumber& number) {
  return {film.actors[number.actor].name, joint_of(film, number).name};
}

}  // namespace

std::optional<JointNumber> joint_named(const animator::Film& film, const std::pair<std::string, std::string>& names) {
  const auto actor = std::ranges::find(film.actors, names.first, &animator::Actor::name);
  if (actor == film.actors.end() || !actor->matrices.empty()) return std::nullopt;
  const std::vector<modeler::Joint>& joints = film.models[actor->model].joints;
  const auto joint = std::ranges::find(joints, names.second, &modeler::Joint::name);
  if (joint == joints.end()) return std::nullopt;
  return JointNumber{static_cast<std::size_t>(actor - film.actors.begin()),
                     static_cast<std::size_t>(joint - joints.begin())};
}

void PoseUnderWay::clear() {
  angles_.clear();
  ++number_;
}

glm::dvec3 PoseUnderWay::pose_at(const animator::Film& film, const JointNumber& number, std::uint32_t frame) const {
  const modeler::Joint& joint = joint_of(film, number);
  const animator::Channel<glm::dvec3>& keys = film.actors[number.actor].motion.pose[number.joint];
  glm::dvec3 pose = animator::JointMotion(joint, keys).pose_at(frame);
  const auto tried = angles_.find(names_of(film, number));
  for (int axis = 0; tried != angles_.end() && axis < 3; ++axis)
    pose[axis] = tried->second[static_cast<std::size_t>(axis)].value_or(pose[axis]);
  return animator::clamped(joint, pose);
}

void PoseUnderWay::set(const animator::Film& film, const JointNumber& joint, int axis, double degrees) {
  angles_[names_of(film, joint)][static_cast<std::size_t>(axis)] = degrees;
  ++number_;
}

void PoseUnderWay::leave_out(const ByNames& angles) {
  std::erase_if(angles_, [&](const auto& each) {
    const auto other = angles.find(each.first);
    return other != angles.end() && other->second == each.second;
  });
  ++number_;
}

void PoseUnderWay::keep_those_of(const animator::Film& film) {
  std::erase_if(angles_, [&](const auto& each) { return !joint_named(film, each.first); });
  ++number_;
}

std::map<std::size_t, animator::ActorState> PoseUnderWay::figures(animator::Film& film, std::uint32_t frame) const {
  std::map<std::size_t, animator::ActorState> figures;
  std::set<std::size_t> posed_actors;
  for (const auto& [names, angles] : angles_) posed_actors.insert(joint_named(film, names)->actor);
  const PosedFilm posed(film, *this, frame);
  for (std::size_t actor = 0; actor < film.actors.size(); ++actor)
    if (std::ranges::any_of(animator::chain_at(film.actors, actor, frame),
                            [&](std::size_t carrier) { return posed_actors.contains(carrier); }))
      figures.emplace(actor, animator::state_at(film, actor, frame));
  return figures;
}

PosedFilm::PosedFilm(animator::Film& film, const PoseUnderWay& pose, std::uint32_t frame) {
  for (const auto& [names, angles] : pose.angles()) {
    const JointNumber number = *joint_named(film, names);
    const glm::dvec3 at = pose.pose_at(film, number, frame);
    animator::Channel<glm::dvec3>& keys = film.actors[number.actor].motion.pose[number.joint];
    before_.emplace_back(&keys, keys);
    animator::set_key(keys, at, frame, joint_of(film, number).rest());
  }
}

PosedFilm::~PosedFilm() {
  for (auto& [keys, before] : before_) *keys = std::move(before);
}

}  // namespace mars::preview
