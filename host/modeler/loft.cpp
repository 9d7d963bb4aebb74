#include "host/modeler/loft.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mars::host {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Pulls a sine or cosine towards +-1.
double squared(double value, double by) {
  const auto pull = [](double v) { return 1.5 * v - 0.5 * v * v * v; };
  return value + by * (pull(pull(value)) - value);
}

// 1 at 0, 0 with slope 0 from -1 and 1 on.
double fade(double x) {
  const double inside = std::max(0.0, 1 - x * x);
  return inside * inside;
}

double swelling_at(std::span<const Swelling> swellings, double at, double angle) {
  double height = 0;
  for (const Swelling& s : swellings) {
    const double along = (at - s.at) / (at < s.at ? s.below : s.above);
    const double degrees = std::abs(angle > kPi ? angle - 2 * kPi : angle) * 180 / kPi;
    height += s.height * fade(along) * fade((degrees - s.angle) / s.reach);
  }
  return height;
}

// The control points of a closed curve; `reach` makes up for what a B-spline falls short of its polygon.
std::vector<glm::dvec3> control_points(const Ring& ring, const Loft& loft) {
  const double reach = 3 / (2 + std::cos(2 * kPi / loft.around));
  std::vector<glm::dvec3> points;
  for (int i = 0; i < loft.around; ++i) {
    const double even = 2 * kPi * i / loft.around, angle = even - loft.crowding * std::sin(even);
    const double square = std::cos(angle) > 0 ? ring.square : ring.square_back;
    const double front = squared(std::cos(angle), square), side = squared(std::sin(angle), square);
    const double out = swelling_at(loft.swellings, ring.at, angle);
    const double forward = reach * front * ((front > 0 ? ring.front : ring.back) + out);
    const double sideways = reach * side * (ring.width + out);
    const double up = ring.at + ring.tilt * (ring.middle + forward);
    points.push_back(loft.frame.origin + (ring.middle + forward) * loft.frame.front +
                     sideways * loft.frame.side + up * loft.frame.axis);
  }
  return points;
}

glm::dvec3 mean(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum(0, 0, 0);
  for (const glm::dvec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

glm::dvec3 between(const glm::dvec3& a, const glm::dvec3& b, double part) { return a + part * (b - a); }

// Bezier points of a closed uniform cubic B-spline, three a span.
std::vector<glm::dvec3> around_bezier(const std::vector<glm::dvec3>& points) {
  const std::size_t count = points.size();
  std::vector<glm::dvec3> bezier(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3& next = points[(i + 1) % count];
    bezier[3 * i + 1] = between(points[i], next, 1.0 / 3);
    bezier[3 * i + 2] = between(points[i], next, 2.0 / 3);
  }
  for (std::size_t i = 0; i < count; ++i)
    bezier[3 * i] = between(bezier[(3 * i + 3 * count - 1) % (3 * count)], bezier[3 * i + 1], 0.5);
  return bezier;
}

// Bezier points of a cubic B-spline with knots 0, 0, 0, 0, 1, 2, ... and likewise at its end, by blossoms.
std::vector<glm::dvec3> along_bezier(const std::vector<glm::dvec3>& points) {
  const int spans = static_cast<int>(points.size()) - 3;
  std::vector<glm::dvec3> bezier(static_cast<std::size_t>(3 * spans + 1));
  for (int s = 0; s < spans; ++s) {
    const double low = std::max(0, s - 1), high = std::min(spans, s + 2);
    for (const int handle : {0, 1})
      bezier[static_cast<std::size_t>(3 * s + 1 + handle)] =
          between(points[static_cast<std::size_t>(s + 1)], points[static_cast<std::size_t>(s + 2)],
                  (s + handle - low) / (high - low));
  }
  bezier.front() = points.front();
  bezier.back() = points.back();
  for (std::size_t knot = 3; knot + 1 < bezier.size(); knot += 3)
    bezier[knot] = between(bezier[knot - 1], bezier[knot + 1], 0.5);
  return bezier;
}

// Columns of control points, each from pole to pole.
std::vector<std::vector<glm::dvec3>> columns(const Loft& loft) {
  std::vector<std::vector<glm::dvec3>> columns(static_cast<std::size_t>(3 * loft.around));
  const auto add_row = [&](const std::vector<glm::dvec3>& row) {
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].push_back(row[i]);
  };
  const auto pole = [&](const Ring& ring) {
    return std::vector<glm::dvec3>(columns.size(), mean(control_points(ring, loft)));
  };
  add_row(pole(loft.rings.front()));
  for (const Ring& ring : loft.rings) add_row(around_bezier(control_points(ring, loft)));
  add_row(pole(loft.rings.back()));
  return columns;
}

}  // namespace

void add_loft(Net& net, const Loft& loft) {
  std::vector<std::vector<glm::dvec3>> beziers;
  for (const auto& column : columns(loft)) beziers.push_back(along_bezier(column));
  for (std::size_t row = 0; row + 3 < beziers[0].size(); row += 3)
    for (std::size_t column = 0; column < beziers.size(); column += 3) {
      auto& patch = net.emplace_back();
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 4; ++i)
          patch[4 * j + i] = beziers[(column + i) % beziers.size()][row + j];
    }
}

std::vector<node::Patch> fill_cube(const Net& net) {
  glm::dvec3 least = net[0][0], greatest = net[0][0];
  for (const auto& patch : net)
    for (const glm::dvec3& point : patch)
      for (int axis = 0; axis < 3; ++axis) {
        least[axis] = std::min(least[axis], point[axis]);
        greatest[axis] = std::max(greatest[axis], point[axis]);
      }
  std::vector<node::Patch> patches(net.size());
  for (std::size_t number = 0; number < net.size(); ++number)
    for (std::size_t i = 0; i < 16; ++i)
      for (int axis = 0; axis < 3; ++axis)
        patches[number].points[i][static_cast<std::size_t>(axis)] =
            static_cast<float>((net[number][i][axis] - least[axis]) / (greatest[axis] - least[axis]));
  return patches;
}

}  // namespace mars::host
