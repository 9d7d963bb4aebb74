#include "host/content/animator/motion/body/reach.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

namespace mars::motion {
namespace {

constexpr int kReachRounds = 80;
constexpr modeler::Limits kAnywhere{-1e300, 1e300};

// A number of the pose that may change, and the line in the world about which it turns; or, where `joint` is kNone,
// one of the actor's place.
struct Freedom {
  std::size_t joint;
  int axis;
  glm::dvec3 about;
  glm::dvec3 through;
  double stiffness = 0;

  bool shifts() const { return joint == modeler::kNone; }
};

double& number(Posture& posture, const Freedom& freedom) {
  return freedom.shifts() ? posture.place[freedom.axis] : posture.pose[freedom.joint][freedom.axis];
}

double number(const Posture& posture, const Freedom& freedom) {
  return freedom.shifts() ? posture.place[freedom.axis] : posture.pose[freedom.joint][freedom.axis];
}

// Frames of joints in a posture, each computed once.
class Frames {
 public:
  Frames(const modeler::Model& model, const Posture& posture)
      : model_(model), posture_(posture), known_(model.joints.size()) {}

  modeler::Axes socket(std::size_t number) {
    const modeler::Joint& joint = model_.joints[number];
    const modeler::Axes parent =
        joint.parent == modeler::kNone ? modeler::Axes{actor_turn(posture_), posture_.place} : of(joint.parent);
    return {parent.turn, parent.turn * joint.place + parent.place};
  }

  const modeler::Axes& of(std::size_t number) {
    if (!known_[number]) {
      const modeler::Axes at = socket(number);
      known_[number] = {at.turn * modeler::orientation(model_.joints[number], posture_.pose[number]), at.place};
    }
    return *known_[number];
  }

 private:
  const modeler::Model& model_;
  const Posture& posture_;
  std::vector<std::optional<modeler::Axes>> known_;
};

std::vector<Freedom> freedoms_of(const modeler::Model& model, const Posture& posture, Frames& frames,
                                 const Search& search) {
  std::vector<Freedom> freedoms;
  if (search.moves_actor)
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 along(0);
      along[axis] = 1;
      freedoms.push_back({modeler::kNone, axis, along, {0, 0, 0}, search.place_stiffness});
    }
  for (std::size_t i = 0; i < search.joints.size(); ++i) {
    const std::size_t number = search.joints[i];
    const modeler::Joint& joint = model.joints[number];
    const modeler::Axes socket = frames.socket(number);
    const glm::dvec3 axes[] = {joint.x_axis, joint.y_axis, glm::normalize(glm::cross(joint.x_axis, joint.y_axis))};
    glm::dmat3 turned = socket.turn;
    for (int axis = 0; axis < 3; ++axis) {
      if (joint.limits[axis].free())
        freedoms.push_back({number, axis, turned * axes[axis], socket.place, search.rest ? search.stiffness[i] : 0.0});
      turned = turned * modeler::rotation_by_degrees(axes[axis], posture.pose[number][axis]);
    }
  }
  return freedoms;
}

// The turn that is still to do, as a vector along its axis, radians.
glm::dvec3 turn_left(const glm::dmat3& wanted, const glm::dmat3& is) {
  const animator::Turn turn = animator::turn_between(is, wanted);
  return turn.angle * turn.axis;
}

// Rows of the equations: what is left to do, and what each freedom does about it.
class Equations {
 public:
  Equations(const modeler::Model& model, const Posture& posture, const Search& search, std::span<const Goal> goals)
      : model_(&model) {
    Frames frames(model, posture);
    freedoms = freedoms_of(model, posture, frames, search);
    for (const Goal& goal : goals) add(goal, frames.of(goal.joint));
    if (!search.rest) return;
    for (const Freedom& f : freedoms) {
      const double off = number(*search.rest, f) - number(posture, f);
      back.push_back(f.stiffness * (f.shifts() ? off : glm::radians(off)));
    }
  }

  double error() const {
    double sum = 0;
    for (const double value : left) sum += value * value;
    for (const double value : back) sum += value * value;
    return sum;
  }

 private:
  void add(const Goal& goal, const modeler::Axes& frame) {
    const glm::dvec3 at = frame.turn * goal.held + frame.place;
    if (goal.place)
      add_vector(goal, goal.place_weight * (*goal.place - at), [&](const Freedom& f) {
        return goal.place_weight * (f.shifts() ? f.about : glm::cross(f.about, at - f.through));
      });
    if (goal.turn)
      add_vector(goal, goal.turn_weight * turn_left(*goal.turn, frame.turn),
                 [&](const Freedom& f) { return f.shifts() ? glm::dvec3(0) : goal.turn_weight * f.about; });
    if (goal.direction) {
      const glm::dvec3 direction = frame.turn * *goal.direction;
      left.push_back(-goal.turn_weight * glm::dot(direction, goal.across));
      for (const Freedom& f : freedoms)
        rates.push_back(moves(f, goal) && !f.shifts()
                            ? goal.turn_weight * glm::dot(glm::cross(f.about, direction), goal.across)
                            : 0);
    }
  }

  template <typename Rate>
  void add_vector(const Goal& goal, const glm::dvec3& error, Rate rate) {
    const std::size_t first = rates.size(), n = freedoms.size();
    rates.resize(first + 3 * n, 0.0);
    for (int row = 0; row < 3; ++row) left.push_back(error[row]);
    for (std::size_t i = 0; i < n; ++i) {
      if (!moves(freedoms[i], goal)) continue;
      const glm::dvec3 moved = rate(freedoms[i]);
      for (std::size_t row = 0; row < 3; ++row) rates[first + row * n + i] = moved[int(row)];
    }
  }

  bool moves(const Freedom& f, const Goal& goal) const {
    return f.shifts() || modeler::is_at_or_below(model_->joints, goal.joint, f.joint);
  }

  const modeler::Model* model_;

 public:
  std::vector<Freedom> freedoms;
  std::vector<double> left;   // one a row
  std::vector<double> rates;  // rows of as many as there are freedoms, per radian
  std::vector<double> back;   // to rest, one a freedom; or none
};

// The step that least squares with damping want of those freedoms that are not `held`, in radians.
std::vector<double> step_of(const Equations& equations, const std::vector<char>& held, double damping) {
  const std::size_t n = equations.freedoms.size(), rows = equations.left.size();
  std::vector<double> a(n * (n + 1), 0.0);
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= n; ++j)
      for (std::size_t row = 0; row < rows; ++row)
        a[i * (n + 1) + j] +=
            equations.rates[row * n + i] * (j < n ? equations.rates[row * n + j] : equations.left[row]);
    if (!equations.back.empty()) {
      const double stiffness = equations.freedoms[i].stiffness;
      a[i * (n + 1) + i] += stiffness * stiffness;
      a[i * (n + 1) + n] += stiffness * equations.back[i];
    }
    largest = std::max(largest, a[i * (n + 1) + i]);
  }
  for (std::size_t i = 0; i < n; ++i) {
    // Numbers that are drawn to rest weigh so differently that each is damped by its own.
    a[i * (n + 1) + i] += damping * (equations.back.empty() ? largest : a[i * (n + 1) + i]) + 1e-300;
    if (!held[i]) continue;
    for (std::size_t j = 0; j <= n; ++j) a[i * (n + 1) + j] = i == j;
  }
  // Gauss; the matrix is positive definite but for held rows, so the diagonal is a good pivot.
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k) {
      const double factor = a[k * (n + 1) + i] / a[i * (n + 1) + i];
      for (std::size_t j = i; j <= n; ++j) a[k * (n + 1) + j] -= factor * a[i * (n + 1) + j];
    }
  std::vector<double> step(n);
  for (std::size_t i = n; i-- > 0;) {
    step[i] = a[i * (n + 1) + n];
    for (std::size_t j = i + 1; j < n; ++j) step[i] -= a[i * (n + 1) + j] * step[j];
    step[i] /= a[i * (n + 1) + i];
  }
  return step;
}

const modeler::Limits& limits_of(const modeler::Model& model, const Freedom& freedom) {
  return freedom.shifts() ? kAnywhere : model.joints[freedom.joint].limits[freedom.axis];
}

// Freedoms that stand at a limit and would go beyond it are held there.
std::vector<double> step_within(const modeler::Model& model, Posture& posture, const Equations& equations,
                                double damping) {
  std::vector<char> held(equations.freedoms.size(), false);
  for (;;) {
    std::vector<double> step = step_of(equations, held, damping);
    bool more = false;
    for (std::size_t i = 0; i < held.size(); ++i) {
      const modeler::Limits& limits = limits_of(model, equations.freedoms[i]);
      const double now = number(posture, equations.freedoms[i]);
      if (held[i] || !((now <= limits.lower && step[i] < 0) || (now >= limits.upper && step[i] > 0))) continue;
      held[i] = more = true;
    }
    if (!more) return step;
  }
}

}  // namespace

void reach(const modeler::Model& model, Posture& posture, const Search& search, std::span<const Goal> goals) {
  double damping = search.rest ? 1e-3 : 1e-4;
  Equations now(model, posture, search, goals);
  for (int round = 0; round < kReachRounds && damping < 1e8; ++round) {
    const std::vector<double> step = step_within(model, posture, now, damping);
    Posture tried = posture;
    double longest = 0;
    for (std::size_t i = 0; i < step.size(); ++i) {
      const modeler::Limits& limits = limits_of(model, now.freedoms[i]);
      longest = std::max(longest, std::abs(step[i]));
      double& value = number(tried, now.freedoms[i]);
      const double change = now.freedoms[i].shifts() ? step[i] : glm::degrees(std::clamp(step[i], -0.5, 0.5));
      value = std::clamp(value + change, limits.lower, limits.upper);
    }
    if (longest < search.small_step) return;
    Equations then(model, tried, search, goals);
    if (then.error() >= now.error()) {
      damping *= 10;
      continue;
    }
    posture = std::move(tried);
    const bool enough = now.error() - then.error() < search.small_gain * now.error();
    now = std::move(then);
    if (enough) return;
    damping = std::max(damping / 10, 1e-12);
  }
}

void reach(const modeler::Model& model, Posture& posture, std::span<const std::size_t> joints,
           std::span<const Goal> goals) {
  reach(model, posture, Search{.joints = joints}, goals);
}

glm::dvec3 nearest_turns(const modeler::Joint& joint, const glm::dmat3& turn, const glm::dvec3& near) {
  modeler::Model alone;
  alone.joints.push_back(joint);
  alone.joints[0].parent = modeler::kNone;
  Posture posture = drawn_posture(alone);
  for (int axis = 0; axis < 3; ++axis)
    posture.pose[0][axis] = std::clamp(near[axis], joint.limits[axis].lower, joint.limits[axis].upper);
  const std::size_t joints[] = {0};
  const Goal goals[] = {{.joint = 0, .turn = turn}};
  reach(alone, posture, joints, goals);
  return posture.pose[0];
}

}  // namespace mars::motion
