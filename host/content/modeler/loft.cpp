#include "host/content/modeler/loft.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <numbers>

#include "host/content/elementary/elementary.h"

namespace mars::modeler {
namespace {

using std::numbers::pi;

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
    const double degrees = std::abs(angle > pi ? angle - 2 * pi : angle) * 180 / pi;
    height += s.height * fade(along) * fade((degrees - s.angle) / s.reach);
  }
  return height;
}

// The control points of a closed curve; `reach` makes up for what a B-spline falls short of its polygon.
std::vector<glm::dvec3> control_points(const Ring& ring, const Loft& loft) {
  const double reach = 3 / (2 + elementary::cos(2 * pi / loft.around));
  std::vector<glm::dvec3> points;
  for (int i = 0; i < loft.around; ++i) {
    const double even = 2 * pi * i / loft.around, angle = even - loft.crowding * elementary::sin(even);
    const double square = elementary::cos(angle) > 0 ? ring.square : ring.square_back;
    const double front = squared(elementary::cos(angle), square), side = squared(elementary::sin(angle), square);
    const double out = swelling_at(loft.swellings, ring.at, angle);
    const double forward = reach * front * ((front > 0 ? ring.front : ring.back) + out);
    const double sideways = reach * side * (ring.width + out);
    const double up = ring.at + ring.tilt * (ring.middle + forward);
    points.push_back(loft.frame.origin + (ring.middle + forward) * loft.frame.front + sideways * loft.frame.side +
                     up * loft.frame.axis);
  }
  return points;
}

glm::dvec3 mean(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum(0, 0, 0);
  for (const glm::dvec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

// A row for each ring, and one at either end that is all its ring's middle.
PointGrid control_net(const Loft& loft) {
  PointGrid rows;
  for (const Ring& ring : loft.rings) rows.push_back(control_points(ring, loft));
  const auto pole = [](const std::vector<glm::dvec3>& row) { return std::vector(row.size(), mean(row)); };
  rows.insert(rows.begin(), pole(rows.front()));
  rows.push_back(pole(rows.back()));
  return rows;
}

}  // namespace

void add_loft(Net& net, const Loft& loft) {
  const PointGrid rows = control_net(loft);
  const Net patches = bezier_patches(rows, uniform_direction(Ends::periodic, 3, rows[0].size()),
                                     uniform_direction(Ends::clamped, 3, rows.size()));
  net.insert(net.end(), patches.begin(), patches.end());
}

std::vector<wire::Patch> fill_cube(const Net& net) {
  glm::dvec3 least = net[0][0], greatest = net[0][0];
  for (const auto& patch : net)
    for (const glm::dvec3& point : patch) {
      least = glm::min(least, point);
      greatest = glm::max(greatest, point);
    }
  Net filling = net;
  for (auto& patch : filling)
    for (glm::dvec3& point : patch) point = (point - least) / (greatest - least);
  return rounded(filling);
}

}  // namespace mars::modeler
