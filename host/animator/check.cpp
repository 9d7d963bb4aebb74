#include "host/animator/check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "host/animator/angles.h"
#include "host/document/fields.h"

namespace mars::host {
namespace {

constexpr double kNoticed = 0.001;  // degrees outside the limits: less is nothing
constexpr double kSeen = 0.5;       // worth a line
constexpr std::uint64_t kQuickly = 2'000'000;  // poses looked at in about a second
constexpr double kDegree = 3.14159265358979323846 / 180;

std::uint32_t last_frame(const Film& film, const Channel<glm::dvec3>& poses) {
  return std::min(film.frames - 1, poses.back().frame);
}

// Only these can leave their limits: a hinge's angle goes straight from key to key.
bool may_leave(const Joint& joint, const Channel<glm::dvec3>& poses) {
  return joint.freedoms() > 1 && poses.size() > 1;
}

double angle_between(const glm::dmat3& a, const glm::dmat3& b) { return turn_between(a, b).angle / kDegree; }

// The worst of one pose; `angle` counts as `outside` degrees too far.
struct Outside {
  int axis = 0;
  double angle = 0, outside = 0;
};

Outside outside_of(const Joint& joint, const glm::dvec3& pose, const glm::dmat3& turn) {
  const double missed = angle_between(orientation(joint, pose), turn);
  if (missed > kNoticed) return {3, missed, missed};
  const glm::dvec3 excess = excess_of(joint, pose);
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (excess[other] > excess[axis]) axis = other;
  return {axis, pose[axis], excess[axis]};
}

void look_at_joint(const Film& film, std::size_t actor, std::size_t number, std::vector<LimitsLeft>& left) {
  const Joint& joint = film.models[film.actors[actor].model].joints[number];
  const Channel<glm::dvec3>& poses = film.actors[actor].motion.pose[number];
  JointMotion motion(joint, poses);
  LimitsLeft all{actor, number, 0, 0, 0, 0, 0, 0, 0};
  for (std::uint32_t frame = poses.front().frame; frame <= last_frame(film, poses); ++frame) {
    const Stretch stretch = stretch_at(poses, frame);
    if (poses[stretch.from].value == poses[stretch.to].value) continue;
    const Outside now = outside_of(joint, motion.pose_at(frame), motion.at(frame));
    if (now.outside <= kNoticed) continue;
    if (all.frames++ == 0) all.first = frame;
    all.last = frame;
    if (now.outside <= all.outside) continue;
    all.worst = frame;
    all.axis = now.axis;
    all.angle = now.angle;
    all.outside = now.outside;
  }
  if (all.frames > 0) left.push_back(all);
}

std::string rounded_text(double number) { return shown(std::round(number * 100) / 100); }

// As a word of the shell.
std::string quoted(const std::string& name) {
  if (name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") == std::string::npos)
    return name;
  std::string text = "'";
  for (const char c : name) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string line_of(const Film& film, const LimitsLeft& left) {
  const Actor& actor = film.actors[left.actor];
  const Joint& joint = film.models[actor.model].joints[left.joint];
  std::string text = "actor '" + actor.name + "', joint '" + joint.name + "': ";
  if (left.axis == 3) {
    text += "its skewed axes do not reach where it turns between keys, by " + rounded_text(left.angle) + " degrees";
  } else {
    const Limits& limits = joint.limits[left.axis];
    text += "turns " + rounded_text(left.angle) + " degrees about " + "xyz"[left.axis] + " between keys, ";
    text += limits.free() ? "outside its limits " + shown(limits.lower) + " to " + shown(limits.upper)
                          : "where it has no freedom and stays at " + shown(limits.lower);
  }
  const std::string worst = std::to_string(left.worst);
  text += ", in frame " + worst;
  if (left.frames > 1)
    text += ", the worst of " + std::to_string(left.frames) + " from " + std::to_string(left.first) + " to " +
            std::to_string(left.last);
  return text + " (mend it with: key " + quoted(actor.name) + " " + quoted(joint.name) + " --frame " + worst +
         " --clamp)";
}

template <typename Value>
bool changes(const Channel<Value>& channel) {
  return std::any_of(channel.begin(), channel.end(), [&](const auto& key) { return key.value != channel[0].value; });
}

bool keyed(const Actor& actor) {
  const auto several = [](const auto& channel) { return channel.size() > 1; };
  return several(actor.motion.place) || several(actor.motion.turn) ||
         std::any_of(actor.motion.pose.begin(), actor.motion.pose.end(), several);
}

bool moves(const Actor& actor) {
  return changes(actor.motion.place) || changes(actor.motion.turn) ||
         std::any_of(actor.motion.pose.begin(), actor.motion.pose.end(), [](const auto& c) { return changes(c); });
}

// How far a figure reaches, about: all its bones in a row, and the longest edge of its boxes.
double size_of(const Model& model) {
  double bones = 0, edge = 0;
  for (const Joint& joint : model.joints) {
    if (joint.parent != kNone) bones += glm::length(joint.place);
    if (!joint.segment) continue;
    const glm::dvec3 box = joint.segment->sbb.max - joint.segment->sbb.min;
    edge = std::max({edge, box.x, box.y, box.z});
  }
  return bones + edge;
}

void find_jumps(const Film& film, const Actor& actor, std::vector<std::string>& lines) {
  const double size = size_of(film.models[actor.model]);
  const auto& place = actor.motion.place;
  for (std::size_t i = 0; i + 1 < place.size(); ++i) {
    const double way = glm::length(place[i + 1].value - place[i].value);
    if (place[i + 1].frame != place[i].frame + 1 || way <= size || size == 0) continue;
    lines.push_back("actor '" + actor.name + "': jumps " + shown(std::round(way * 1000) / 1000) + " from frame " +
                    std::to_string(place[i].frame) + " to the next, farther than it is long");
  }
}

}  // namespace

std::vector<LimitsLeft> limits_left(const Film& film) {
  std::vector<LimitsLeft> left;
  for (std::size_t actor = 0; actor < film.actors.size(); ++actor) {
    const auto& joints = film.models[film.actors[actor].model].joints;
    for (std::size_t joint = 0; joint < joints.size(); ++joint)
      if (may_leave(joints[joint], film.actors[actor].motion.pose[joint])) look_at_joint(film, actor, joint, left);
  }
  return left;
}

Findings check_film(const Film& film) {
  Findings findings;
  std::vector<std::string>& lines = findings.lines;
  std::size_t small = 0;
  for (const LimitsLeft& left : limits_left(film))
    left.outside > kSeen ? lines.push_back(line_of(film, left)) : void(++small);
  for (const Actor& actor : film.actors) {
    const std::string name = "actor '" + actor.name + "': ";
    // A key just behind the end is where a film that is played round and round begins again.
    if (const std::uint32_t last = last_key(actor.motion); last > film.frames)
      lines.push_back(name + "has keys up to frame " + std::to_string(last) + ", behind the film's last, " +
                      std::to_string(film.frames - 1) + " (give the film more frames, or delete them)");
    if (keyed(actor) && !moves(actor))
      lines.push_back(name + "has keys that are all the same: it never moves");
    find_jumps(film, actor, lines);
  }
  findings.trouble = !lines.empty();
  if (small > 0)
    lines.push_back(std::to_string(small) + (lines.empty() ? "" : " more") +
                    (small == 1 ? " joint is outside its" : " joints are outside their") +
                    " limits between keys by less than " + shown(kSeen) + " degrees");
  return findings;
}

std::string limits_remark(const Film& film) {
  std::uint64_t poses = 0;
  for (const Actor& actor : film.actors)
    for (std::size_t joint = 0; joint < actor.motion.pose.size(); ++joint)
      if (may_leave(film.models[actor.model].joints[joint], actor.motion.pose[joint]))
        poses += last_frame(film, actor.motion.pose[joint]);
  if (poses > kQuickly) return "";
  const std::vector<LimitsLeft> left = limits_left(film);
  const auto joints =
      std::count_if(left.begin(), left.end(), [](const LimitsLeft& each) { return each.outside > kSeen; });
  if (joints == 0) return "";
  return film.source + ": " + std::to_string(joints) +
         (joints == 1 ? " joint leaves its limits" : " joints leave their limits") +
         " between keys (mars animate " + quoted(film.source) + " check tells more)";
}

}  // namespace mars::host
