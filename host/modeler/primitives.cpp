#include "host/modeler/primitives.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace mars::host {
namespace {

struct Flat {
  double x;
  double y;
};

constexpr std::size_t kArcs = 8;                      // in a whole turn
constexpr double kHandle = 0.26521648983954400922;    // 4/3 tan(45 degrees / 4)
constexpr double kDiagonal = 0.70710678118654752440;  // sin 45 degrees

// Control points of a unit circle from (1, 0) on, counter-clockwise; its quarters are the same numbers.
std::array<Flat, 3 * kArcs> circle() {
  constexpr double d = kDiagonal, h = kHandle;
  std::array<Flat, 3 * kArcs> points{
      {{1, 0}, {1, h}, {d + h * d, d - h * d}, {d, d}, {d - h * d, d + h * d}, {h, 1}}};
  for (std::size_t i = 6; i < points.size(); ++i) points[i] = {-points[i - 6].y, points[i - 6].x};
  return points;
}

float placed(double coordinate) { return static_cast<float>(0.5 + 0.5 * coordinate); }

// Turns a profile of cubic curves, points (radius, height) in -1..1, about the z axis. Outside is on its
// right.
std::vector<node::Patch> revolve(const std::vector<Flat>& profile) {
  const auto ring = circle();
  std::vector<node::Patch> patches;
  for (std::size_t curve = 0; curve + 3 < profile.size(); curve += 3)
    for (std::size_t arc = 0; arc < ring.size(); arc += 3) {
      node::Patch& patch = patches.emplace_back();
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 4; ++i) {
          const Flat& around = ring[(arc + i) % ring.size()];
          const Flat& along = profile[curve + j];
          patch.points[4 * j + i] = {placed(along.x * around.x), placed(along.x * around.y), placed(along.y)};
        }
    }
  return patches;
}

void line_to(std::vector<Flat>& profile, Flat end) {
  const Flat start = profile.back();
  for (const double part : {1.0 / 3, 2.0 / 3})
    profile.push_back({start.x + part * (end.x - start.x), start.y + part * (end.y - start.y)});
  profile.push_back(end);
}

}  // namespace

std::vector<node::Patch> make_box() {
  constexpr std::array<float, 4> at = {0, 1.0f / 3, 2.0f / 3, 1};
  std::vector<node::Patch> patches;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      const std::size_t u = (axis + (far ? 1 : 2)) % 3, v = (axis + (far ? 2 : 1)) % 3;
      node::Patch& patch = patches.emplace_back();
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 4; ++i) {
          auto& point = patch.points[4 * j + i];
          point[axis] = far ? 1 : 0;
          point[u] = at[i];
          point[v] = at[j];
        }
    }
  return patches;
}

std::vector<node::Patch> make_sphere() {
  const auto ring = circle();
  std::vector<Flat> profile;  // from the south pole, a quarter turn back on the ring, to the north pole
  for (std::size_t i = 18; i <= 30; ++i) profile.push_back(ring[i % ring.size()]);
  return revolve(profile);
}

std::vector<node::Patch> make_cylinder() { return make_cone(1); }

std::vector<node::Patch> make_cone(double top) {
  std::vector<Flat> profile = {{0, -1}};
  line_to(profile, {1, -1});
  line_to(profile, {top, 1});
  if (top > 0) line_to(profile, {0, 1});
  return revolve(profile);
}

std::vector<node::Patch> make_torus(double tube) {
  const auto ring = circle();
  const double across = 2 * tube;  // in the profile's units
  std::vector<Flat> profile;
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    const Flat& point = ring[i % ring.size()];
    profile.push_back({1 - across + across * point.x, point.y});
  }
  return revolve(profile);
}

}  // namespace mars::host
