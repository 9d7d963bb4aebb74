#include "host/content/animator/motion/reach.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

namespace mars::motion {
namespace {

constexpr int kRounds = 80;
constexpr double kSmallStep = 1e-9;  // radians: nothing more to gain

// A number of the pose that may change, and the line in the world about which it turns.
struct Freedom {
  std::size_t joint;
  int axis;
  glm::dvec3 about;
  glm::dvec3 through;
};

double& number(Posture& posture, const Freedom& freedom) { return posture.pose[freedom.joint][freedom.axis]; }

bool is_above(const modeler::Model& model, std::size_t ancestor, std::size_t joint) {
  while (joint != modeler::kNone && joint != ancestor) joint = model.joints[joint].parent;
  return joint == ancestor;
}

std::vector<Freedom> freedoms_of(const modeler::Model& model, const Posture& posture,
                                 std::span<const std::size_t> joints) {
  std::vector<Freedom> freedoms;
  for (const std::size_t number : joints) {
    const modeler::Joint& joint = model.joints[number];
    const modeler::Axes socket = socket_in(model, posture, number);
    const glm::dvec3 axes[] = {joint.x_axis, joint.y_axis, glm::normalize(glm::cross(joint.x_axis, joint.y_axis))};
    glm::dmat3 turned = socket.turn;
    for (int axis = 0; axis < 3; ++axis) {
      if (joint.limits[axis].free()) freedoms.push_back({number, axis, turned * axes[axis], socket.place});
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
  Equations(const modeler::Model& model, const Posture& posture, std::span<const std::size_t> joints,
            std::span<const Goal> goals)
      : model_(model), freedoms(freedoms_of(model, posture, joints)) {
    for (const Goal& goal : goals) add(goal, frame_in(model, posture, goal.joint));
  }

  double error() const {
    double sum = 0;
    for (const double value : left) sum += value * value;
    return sum;
  }

 private:
  void add(const Goal& goal, const modeler::Axes& frame) {
    if (goal.place)
      add_vector(goal, *goal.place - frame.place,
                 [&](const Freedom& f) { return glm::cross(f.about, frame.place - f.through); });
    if (goal.turn)
      add_vector(goal, goal.turn_weight * turn_left(*goal.turn, frame.turn),
                 [&](const Freedom& f) { return goal.turn_weight * f.about; });
    if (goal.direction) {
      const glm::dvec3 direction = frame.turn * *goal.direction;
      left.push_back(-goal.turn_weight * glm::dot(direction, goal.across));
      for (const Freedom& f : freedoms)
        rates.push_back(moves(f, goal) ? goal.turn_weight * glm::dot(glm::cross(f.about, direction), goal.across) : 0);
    }
  }

  template <typename Rate>
  void add_vector(const Goal& goal, const glm::dvec3& error, Rate rate) {
    for (int row = 0; row < 3; ++row) {
      left.push_back(error[row]);
      for (const Freedom& f : freedoms) rates.push_back(moves(f, goal) ? rate(f)[row] : 0);
    }
  }

  bool moves(const Freedom& f, const Goal& goal) const { return is_above(model_, f.joint, goal.joint); }

  const modeler::Model& model_;

 public:
  std::vector<Freedom> freedoms;
  std::vector<double> left;   // one a row
  std::vector<double> rates;  // rows of as many as there are freedoms, per radian
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
    largest = std::max(largest, a[i * (n + 1) + i]);
  }
  for (std::size_t i = 0; i < n; ++i) {
    a[i * (n + 1) + i] += damping * largest + 1e-300;
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
  return model.joints[freedom.joint].limits[freedom.axis];
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

void reach(const modeler::Model& model, Posture& posture, std::span<const std::size_t> joints,
           std::span<const Goal> goals) {
  double damping = 1e-4;
  Equations now(model, posture, joints, goals);
  for (int round = 0; round < kRounds && damping < 1e8; ++round) {
    const std::vector<double> step = step_within(model, posture, now, damping);
    Posture tried = posture;
    double longest = 0;
    for (std::size_t i = 0; i < step.size(); ++i) {
      const modeler::Limits& limits = limits_of(model, now.freedoms[i]);
      longest = std::max(longest, std::abs(step[i]));
      double& value = number(tried, now.freedoms[i]);
      value = std::clamp(value + glm::degrees(std::clamp(step[i], -0.5, 0.5)), limits.lower, limits.upper);
    }
    if (longest < kSmallStep) return;
    const Equations then(model, tried, joints, goals);
    if (then.error() >= now.error()) {
      damping *= 10;
      continue;
    }
    posture = std::move(tried);
    now.freedoms = then.freedoms;
    now.left = then.left;
    now.rates = then.rates;
    damping = std::max(damping / 10, 1e-12);
  }
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
