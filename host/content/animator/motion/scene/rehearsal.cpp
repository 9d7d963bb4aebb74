#include "host/content/animator/motion/scene/rehearsal.h"

#include <algorithm>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/pose/joint_frames.h"

namespace mars::motion {
namespace {

// The channel's later keys make way for the new ones.
template <typename Value>
void put_key(animator::Channel<Value>& channel, std::uint32_t frame, const Value& value, animator::Ease ease) {
  std::erase_if(channel, [&](const animator::Key<Value>& key) { return key.frame >= frame; });
  channel.push_back({frame, value, ease});
}

void put_keys(const animator::Film& film, const std::vector<animator::ActorKey>& keys, animator::Actor& actor) {
  const std::vector<modeler::Joint>& joints = film.models[actor.model].joints;
  for (const animator::ActorKey& key : keys) {
    const animator::Ease ease = key.ease.value_or(animator::kLinear);
    if (key.place) put_key(actor.motion.place, key.frame, *key.place, ease);
    if (key.turn) put_key(actor.motion.turn, key.frame, *key.turn, ease);
    for (std::size_t joint = 0; joint < joints.size(); ++joint)
      if (const auto found = key.pose.find(joints[joint].name); found != key.pose.end())
        put_key(actor.motion.pose[joint], key.frame, found->second, ease);
  }
}

std::size_t index_of(const std::vector<animator::Actor>& actors, const std::string& name) {
  return std::size_t(std::find_if(actors.begin(), actors.end(), [&](const auto& each) { return each.name == name; }) -
                     actors.begin());
}

std::size_t joint_of(const modeler::Model& model, const std::string& name) {
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint)
    if (model.joints[joint].name == name) return joint;
  return modeler::kNone;
}

}  // namespace

Rehearsal::Rehearsal(const Scene& scene)
    : begin_(scene),
      film_(scene.film),
      actor_(index_of(scene.film.actors, scene.actor.name)),
      at_(scene.at),
      motion_{{}, scene.at} {}

Scene Rehearsal::scene(const Arguments& arguments) const {
  return {film_, film_.actors[actor_], at_, arguments, begin_.action};
}

void Rehearsal::perform(Motion (*action)(const Scene& scene), Arguments::Values values) {
  const Arguments arguments(std::move(values), begin_.arguments.where());
  add(action(scene(arguments)));
}

void Rehearsal::add(const Motion& motion) {
  put_keys(film_, motion.keys, film_.actors[actor_]);
  motion_.keys.insert(motion_.keys.end(), motion.keys.begin(), motion.keys.end());
  motion_.report = motion.report;
  motion_.last = std::max(motion_.last, motion.last);
  at_ = motion.last;
}

void Rehearsal::attach(std::size_t actor, std::uint32_t frame, const animator::AttachKey& to) {
  const animator::ActorState state = animator::state_at(film_, actor, frame);
  animator::ActorKey key;
  key.frame = frame;
  key.place = animator::rounded(state.place);
  key.turn = animator::rounded(state.turn);
  key.ease = animator::kLinear;
  key.attach = to;
  animator::Actor& other = film_.actors[actor];
  std::optional<animator::Attachment> carrier;
  if (!to.actor.empty()) {
    const std::size_t by = index_of(film_.actors, to.actor);
    carrier = {by, joint_of(film_.model_of(by), to.joint), to.place, to.turn};
  }
  put_keys(film_, {key}, other);
  put_key(other.attach, frame, carrier, animator::kLinear);
  motion_.others[other.name].push_back(std::move(key));
}

void Rehearsal::perform(std::size_t actor, std::uint32_t frame, Motion (*action)(const Scene& scene),
                        Arguments::Values values) {
  const Arguments arguments(std::move(values), begin_.arguments.where());
  const Motion motion = action({film_, film_.actors[actor], frame, arguments, begin_.action});
  put_keys(film_, motion.keys, film_.actors[actor]);
  auto& keys = motion_.others[film_.actors[actor].name];
  keys.insert(keys.end(), motion.keys.begin(), motion.keys.end());
}

}  // namespace mars::motion
