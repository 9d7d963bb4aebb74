#include "host/content/animator/motion/script/resting.h"

#include <algorithm>

#include "host/content/animator/motion/body/arms.h"
#include "host/content/animator/motion/body/glide.h"
#include "host/content/animator/motion/body/stance.h"
#include "host/content/animator/motion/gaits/gait.h"

namespace mars::motion {
namespace {

std::vector<std::size_t> arm_of(const Body& body, modeler::Side side) {
  std::vector<std::size_t> joints;
  for (const modeler::Limb limb : {modeler::Limb::shoulder, modeler::Limb::elbow, modeler::Limb::wrist})
    if (const std::size_t joint = body.find(limb, side); joint != modeler::kNone) joints.push_back(joint);
  return joints;
}

bool keyed(const animator::FigureMotion& motion, std::span<const std::size_t> joints) {
  return std::any_of(joints.begin(), joints.end(), [&](std::size_t joint) { return !motion.pose[joint].empty(); });
}

}  // namespace

std::optional<animator::ActorKey> hanging_arms(const Scene& scene) {
  if (has_four_legs(scene.model())) return std::nullopt;
  const Body body = body_without_legs(scene.model(), scene.actor.name);
  std::optional<animator::ActorKey> key;
  for (const modeler::Side side : kSides) {
    const std::vector<std::size_t> arm = arm_of(body, side);
    if (!is_drawn_out(body, side) || keyed(scene.actor.motion, arm)) continue;
    const auto ease = at_ease(body);
    if (!key) key.emplace();
    key->frame = scene.at;
    key->ease = animator::kLinear;
    for (const std::size_t joint : arm) {
      const modeler::Joint& turned = scene.model().joints[joint];
      key->pose[turned.name] = two_digits(turned, numbers_for(body, joint, ease.at(joint), turned.rest()));
    }
  }
  return key;
}

animator::Film with_key(const Scene& scene, const animator::ActorKey& key) {
  animator::Film film = scene.film;
  animator::Actor& actor = film.actors[std::size_t(&scene.actor - scene.film.actors.data())];
  const std::vector<modeler::Joint>& joints = scene.model().joints;
  for (std::size_t joint = 0; joint < joints.size(); ++joint)
    if (const auto pose = key.pose.find(joints[joint].name); pose != key.pose.end())
      actor.motion.pose[joint] = {{key.frame, pose->second, animator::kLinear}};
  return film;
}

void leave_out_idle(const Scene& scene, std::vector<animator::ActorKey>& keys) {
  const std::vector<modeler::Joint>& joints = scene.model().joints;
  for (std::size_t joint = 0; joint < joints.size(); ++joint) {
    if (scene.model().limbs.has(joint) || !scene.actor.motion.pose[joint].empty()) continue;
    const std::string& name = joints[joint].name;
    const bool moves = std::any_of(keys.begin(), keys.end(), [&](const animator::ActorKey& key) {
      const auto pose = key.pose.find(name);
      return pose != key.pose.end() && pose->second != joints[joint].rest();
    });
    if (moves) continue;
    for (animator::ActorKey& key : keys) key.pose.erase(name);
  }
}

}  // namespace mars::motion
