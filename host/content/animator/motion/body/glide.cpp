#include "host/content/animator/motion/body/glide.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "host/content/animator/pose/angles.h"
#include "host/content/animator/motion/body/curve.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr double kLegTolerance = 0.03, kJointTolerance = 0.3;  // degrees
constexpr double kGlideTolerance = 2e-4;                       // of the leg's length
constexpr int kMostFramesBetweenKeys = 48;                     // frames from key to key at most

double rounded_to(double value, double digit) { return animator::rounded(std::round(value / digit) * digit); }

glm::dvec3 rounded_to(const glm::dvec3& v, double digit) {
  return {rounded_to(v.x, digit), rounded_to(v.y, digit), rounded_to(v.z, digit)};
}

// A power of ten that is small against the figure.
double place_digit(const Body& body) {
  return elementary::pow(10, std::floor(elementary::log10(body.leg_length() * 1e-4)));
}

double share(std::size_t from, std::size_t to, std::size_t at) { return double(at - from) / double(to - from); }

// The same turn of a free joint, each number from -180 to 180.
glm::dvec3 within_a_turn(const glm::dvec3& turn) {
  return {std::remainder(turn.x, 360), std::remainder(turn.y, 360), std::remainder(turn.z, 360)};
}

class Keying {
 public:
  Keying(std::span<const Posture> postures, std::uint32_t first) : postures_(postures), keys_(postures.size()) {
    for (std::size_t i = 0; i < keys_.size(); ++i) keys_[i].frame = first + std::uint32_t(i);
  }

  template <typename Value, typename Put>
  void add_turns(const modeler::Joint& joint, double tolerance, Value value, Put put) {
    std::vector<glm::dvec3> values;
    for (const Posture& posture : postures_) values.push_back(two_digits(joint, value(posture)));
    choose_keys(
        values.size(),
        [&](std::size_t a, std::size_t b, std::size_t at) {
          return strays(joint, values[a], values[b], share(a, b, at), values[at], tolerance);
        },
        [&](std::size_t at) { put(keys_[at], values[at]); });
  }

  void add_joint(const modeler::Model& model, std::size_t number, double tolerance) {
    const modeler::Joint& joint = model.joints[number];
    if (joint.freedoms() == 0) return;
    add_turns(
        joint, tolerance, [&](const Posture& p) { return p.pose[number]; },
        [&](animator::ActorKey& key, const glm::dvec3& turns) { key.pose[joint.name] = turns; });
  }

  void add_places(double digit, double tolerance) {
    choose_keys(
        postures_.size(),
        [&](std::size_t a, std::size_t b, std::size_t at) {
          const glm::dvec3 way = glm::mix(postures_[a].place, postures_[b].place, share(a, b, at));
          return glm::distance(way, postures_[at].place) > tolerance;
        },
        [&](std::size_t at) { keys_[at].place = rounded_to(postures_[at].place, digit); });
  }

  std::vector<animator::ActorKey> take() {
    std::erase_if(keys_, [](const animator::ActorKey& key) { return !key.place && !key.turn && key.pose.empty(); });
    for (animator::ActorKey& key : keys_) key.ease = animator::kLinear;
    return std::move(keys_);
  }

 private:
  std::span<const Posture> postures_;
  std::vector<animator::ActorKey> keys_;
};

bool carries_legs(const Body& body, std::size_t joint) {
  const auto carries = [&](const Leg& leg) {
    return modeler::is_at_or_below(body.model->joints, leg.toes == modeler::kNone ? leg.ankle : leg.toes, joint);
  };
  return std::any_of(body.legs.begin(), body.legs.end(), carries) ||
         (body.forelegs && std::any_of(body.forelegs->begin(), body.forelegs->end(), carries));
}

}  // namespace

void choose_keys(std::size_t count, const std::function<bool(std::size_t, std::size_t, std::size_t)>& strays,
                 const std::function<void(std::size_t)>& put) {
  std::size_t from = 0;
  put(0);
  while (from + 1 < count) {
    std::size_t to = from + 1;
    const auto holds = [&](std::size_t last) {
      for (std::size_t at = from + 1; at < last; ++at)
        if (strays(from, last, at)) return false;
      return true;
    };
    while (to + 1 < count && to + 1 - from <= kMostFramesBetweenKeys && holds(to + 1)) ++to;
    put(to);
    from = to;
  }
}

bool strays(const modeler::Joint& joint, const glm::dvec3& a, const glm::dvec3& b, double part, const glm::dvec3& is,
            double tolerance) {
  if (a == b) return glm::distance(a, is) > tolerance;
  if (joint.freedoms() == 1) return glm::distance(a + part * (b - a), is) > tolerance;
  const glm::dmat3 start = modeler::orientation(joint, a);
  const animator::Turn turn = animator::turn_between(start, modeler::orientation(joint, b));
  const glm::dmat3 shown = modeler::rotation(turn.axis, part * turn.angle) * start;
  return glm::degrees(animator::turn_between(shown, modeler::orientation(joint, is)).angle) > tolerance ||
         animator::largest_excess(joint, animator::pose_of(joint, shown, is)) > animator::kAngleRounding;
}

glm::dvec3 two_digits(const modeler::Joint& joint, const glm::dvec3& pose) {
  return animator::clamped(joint, rounded_to(pose, 0.01));
}

void begin_at(const modeler::Model& model, const Posture& start, double frames, std::vector<Posture>& postures) {
  const Posture first = postures.front();
  const auto off = [](const glm::dvec3& a, const glm::dvec3& b) { return a - b; };
  for (std::size_t at = 0; at < postures.size() && double(at) < frames; ++at) {
    const double left = 1 - smooth(0, frames, double(at));
    Posture& posture = postures[at];
    posture.place += left * off(start.place, first.place);
    for (std::size_t joint = 0; joint < posture.pose.size(); ++joint)
      posture.pose[joint] = animator::clamped(model.joints[joint],
                                              posture.pose[joint] + left * off(start.pose[joint], first.pose[joint]));
  }
}

std::vector<animator::ActorKey> keys_of(const Body& body, std::span<const std::size_t> joints,
                                        std::span<const Posture> postures, std::uint32_t first) {
  Keying keying(postures, first);
  keying.add_places(place_digit(body), kGlideTolerance * body.leg_length());
  keying.add_turns(
      modeler::Joint{}, kLegTolerance, [](const Posture& p) { return within_a_turn(p.turn); },
      [](animator::ActorKey& key, const glm::dvec3& turn) { key.turn = turn; });
  for (const std::size_t joint : joints)
    keying.add_joint(*body.model, joint, carries_legs(body, joint) ? kLegTolerance : kJointTolerance);
  return keying.take();
}

std::vector<animator::ActorKey> keys_of_joints(const modeler::Model& model, std::span<const std::size_t> joints,
                                               std::span<const Posture> postures, std::uint32_t first,
                                               double tolerance) {
  Keying keying(postures, first);
  for (const std::size_t joint : joints) keying.add_joint(model, joint, tolerance);
  return keying.take();
}

}  // namespace mars::motion
