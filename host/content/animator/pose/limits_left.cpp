#include "host/content/animator/pose/limits_left.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "host/content/animator/pose/angles.h"
#include "host/content/elementary/elementary.h"
#include "host/content/modeler/frames.h"

namespace mars::animator {
namespace {

constexpr double kPrecision = 0.005;  // degrees by which the worst of a search may be missed

using Poses = Channel<glm::dvec3>;

std::uint32_t last_frame(const Film& film, const Poses& poses) { return std::min(film.frames - 1, poses.back().frame); }

bool square(const modeler::Joint& joint) { return std::abs(glm::dot(joint.x_axis, joint.y_axis)) < 1e-9; }

// Every orientation has angles within half a turn about x and z and within a quarter about y.
bool holds_every_turn(const modeler::Joint& joint) {
  const auto holds = [&](int axis, double degrees) {
    return joint.limits[axis].lower <= -degrees && joint.limits[axis].upper >= degrees;
  };
  return square(joint) && holds(0, 180) && holds(1, 90) && holds(2, 180);
}

// A hinge's angle goes straight from key to key and stays within its limits; a spline is held within them.
bool may_leave(const modeler::Joint& joint, const Poses& poses) {
  return joint.freedoms() > 1 && poses.size() > 1 && !holds_every_turn(joint);
}

template <typename Look>
void for_each_that_may_leave(const Film& film, Look look) {
  for (std::size_t actor = 0; actor < film.actors.size(); ++actor) {
    const auto& joints = film.model_of(actor).joints;
    for (std::size_t joint = 0; joint < joints.size(); ++joint)
      if (const Poses& poses = film.actors[actor].motion.pose[joint]; may_leave(joints[joint], poses))
        look(actor, joint, joints[joint], poses);
  }
}

double angle_between(const glm::dmat3& a, const glm::dmat3& b) { return turn_between(a, b).angle / modeler::kDegree; }

// How far outside one pose is; `angle` counts as `outside` degrees too far.
struct Excess {
  int axis = 0;
  double angle = 0, outside = 0;
};

Excess excess_at(const modeler::Joint& joint, const glm::dvec3& pose, const glm::dmat3& turn) {
  const double missed = angle_between(modeler::orientation(joint, pose), turn);
  if (missed > kExcessNoticed) return {3, missed, missed};
  const glm::dvec3 excess = excess_of(joint, pose);
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (excess[other] > excess[axis]) axis = other;
  return {axis, pose[axis], excess[axis]};
}

void count_frames(const Film& film, std::size_t actor, std::size_t number, const modeler::Joint& joint,
                  const Poses& poses, std::vector<LimitsLeft>& left) {
  JointMotion motion(joint, poses);
  LimitsLeft all{{actor, number, 0, 0, 0, 0}, 0, 0, 0};
  for (std::uint32_t frame = poses.front().frame; frame <= last_frame(film, poses); ++frame) {
    const Stretch stretch = stretch_at(poses, frame);
    const Key<glm::dvec3>& from = poses[stretch.from];
    if (from.ease.spline || from.value == poses[stretch.to].value) continue;
    const Excess now = excess_at(joint, motion.pose_at(frame), motion.at(frame));
    if (now.outside <= kExcessNoticed) continue;
    if (all.frames++ == 0) all.first = frame;
    all.last = frame;
    if (now.outside > all.worst.outside) all.worst = {actor, number, frame, now.axis, now.angle, now.outside};
  }
  if (all.frames > 0) left.push_back(all);
}

// How many degrees the angles of a joint with square axes can stray from the straight line between two poses while it
// makes the smallest turn, of `degrees`, from one to the other; infinite where nothing is known. A turn at constant
// speed w = (p, q, r), as the joint sees it, changes the angles a, b, c by u / cos b, v and r - u tan b, where
// u = p cos c - q sin c and v = p sin c + q cos c; so u' = -c' v and v' = c' u. The second derivatives that follow are
// bounded by |w| and |b|, and a curve strays from its chord by an eighth of them. b itself changes by half the turn at
// most from the nearer end.
double most_straying(const glm::dvec3& from, const glm::dvec3& to, double degrees) {
  const auto from_pole = [](double b) { return std::abs(std::remainder(b - 90, 180)); };  // of cos b = 0
  const double nearest = std::min(from_pole(from.y), from_pole(to.y)) - degrees / 2;
  if (nearest <= 0 || std::floor((from.y + 90) / 180) != std::floor((to.y + 90) / 180))
    return std::numeric_limits<double>::infinity();
  const double secant = 1 / elementary::sin(nearest * modeler::kDegree),
               tangent = 1 / elementary::tan(nearest * modeler::kDegree);
  // Else the numbers of the second pose are whole turns away from where the turn ends.
  if (std::max(std::abs(from.x - to.x), std::abs(from.z - to.z)) + degrees * secant >= 360)
    return std::numeric_limits<double>::infinity();
  const double bend =
      std::max({secant * (0.5 + tangent), 0.5 + tangent, (tangent + tangent * tangent + secant * secant) / 2});
  return degrees * degrees * modeler::kDegree / 8 * bend;
}

// Searches the way between two keys for the worst frame. Frames are halved until what lies between two cannot be
// worse than what is known.
class Search {
 public:
  Search(const modeler::Joint& joint, const Poses& poses, std::uint32_t last)
      : joint_(joint), poses_(poses), last_(last), motion_(joint, poses) {}

  struct Found {
    std::uint32_t frame;
    Excess excess;
  };

  std::optional<Found> worst() {
    for (std::size_t key = 0; key + 1 < poses_.size() && poses_[key].frame < last_; ++key) search_after(key);
    return worst_.excess.outside > kExcessSeen ? std::optional(worst_) : std::nullopt;
  }

 private:
  struct At {
    std::uint32_t frame;
    double part;
    glm::dvec3 pose;
    double outside;
  };

  // The pose of a key itself keeps the limits.
  void search_after(std::size_t key) {
    const glm::dvec3 &from = poses_[key].value, &to = poses_[key + 1].value;
    if (poses_[key].ease.spline || poses_[key].ease.hold || from == to) return;
    bounded_ = square(joint_) && steady(poses_[key].ease);
    // The turn is no larger than the three turns together, which cost no matrix.
    const glm::dvec3 change = glm::abs(to - from);
    if (bounded_ && cannot_exceed(0, from, to, change.x + change.y + change.z)) return;
    degrees_ = angle_between(modeler::orientation(joint_, from), modeler::orientation(joint_, to));
    if (bounded_ && cannot_exceed(0, from, to, degrees_)) return;
    const std::uint32_t next = poses_[key + 1].frame;
    halve({poses_[key].frame, 0, from, 0}, next <= last_ ? At{next, 1, to, 0} : look(last_));
  }

  // Never goes back: what lies between two frames lies between them on the way, too.
  static bool steady(const Ease& ease) { return std::min(ease.y1, ease.y2) >= 0 && std::max(ease.y1, ease.y2) <= 1; }

  bool cannot_exceed(double ends, const glm::dvec3& from, const glm::dvec3& to, double degrees) const {
    return ends + most_straying(from, to, degrees) <= std::max(kExcessSeen, worst_.excess.outside + kPrecision);
  }

  At look(std::uint32_t frame) {
    const glm::dvec3 pose = motion_.pose_at(frame);
    const Excess excess = excess_at(joint_, pose, motion_.at(frame));
    if (excess.outside > worst_.excess.outside) worst_ = {frame, excess};
    return {frame, stretch_at(poses_, frame).part, pose, excess.outside};
  }

  void halve(const At& a, const At& b) {
    if (b.frame - a.frame < 2) return;
    const double ends = std::max(a.outside, b.outside);
    if (bounded_ && cannot_exceed(ends, a.pose, b.pose, degrees_ * (b.part - a.part))) return;
    const At middle = look(a.frame + (b.frame - a.frame) / 2);
    halve(a, middle);
    halve(middle, b);
  }

  const modeler::Joint& joint_;
  const Poses& poses_;
  std::uint32_t last_;
  JointMotion motion_;
  bool bounded_ = false;  // most_straying() holds between the two keys
  double degrees_ = 0;    // of the turn from one to the other
  Found worst_{0, {}};
};

}  // namespace

std::vector<LimitsLeft> limits_left(const Film& film) {
  std::vector<LimitsLeft> left;
  for_each_that_may_leave(film, [&](std::size_t actor, std::size_t number, const modeler::Joint& joint,
                                    const Poses& poses) { count_frames(film, actor, number, joint, poses, left); });
  return left;
}

std::vector<WorstExcess> worst_excesses(const Film& film) {
  std::vector<WorstExcess> worst;
  for_each_that_may_leave(film, [&](std::size_t actor, std::size_t number, const modeler::Joint& joint,
                                    const Poses& poses) {
    if (const auto found = Search(joint, poses, last_frame(film, poses)).worst())
      worst.push_back({actor, number, found->frame, found->excess.axis, found->excess.angle, found->excess.outside});
  });
  return worst;
}

}  // namespace mars::animator
