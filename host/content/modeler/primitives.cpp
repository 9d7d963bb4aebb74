#include "host/content/modeler/primitives.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace mars::modeler {
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
  std::array<Flat, 3 * kArcs> points{{{1, 0}, {1, h}, {d + h * d, d - h * d}, {d, d}, {d - h * d, d + h * d}, {h, 1}}};
  for (std::size_t i = 6; i < points.size(); ++i) points[i] = {-points[i - 6].y, points[i - 6].x};
  return points;
}

float placed(double coordinate) { return static_cast<float>(0.5 + 0.5 * coordinate); }

// Turns a profile of cubic curves, points (radius, height) in -1..1, about the z axis. Outside is on its
// right.
std::vector<wire::Patch> revolve(const std::vector<Flat>& profile) {
  const auto ring = circle();
  std::vector<wire::Patch> patches;
  for (std::size_t curve = 0; curve + 3 < profile.size(); curve += 3)
    for (std::size_t arc = 0; arc < ring.size(); arc += 3) {
      wire::Patch& patch = patches.emplace_back();
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 4; ++i) {
          const Flat& around = ring[(arc + i) % ring.size()];
          const Flat& along = profile[curve + j];
          patch.points[4 * j + i] = {placed(along.x * around.x), placed(along.x * around.y), placed(along.y)};
        }
    }
  return patches;
}

// A coordinate on a rounding of radius `radius` next to the wall at `wall` (-1 or 1; 0 for one that is about
// the middle), `out` being the unit circle's own. Exact at the wall.
double rounded_at(double wall, double radius, double out) { return wall + radius * (out - wall); }

// Appends points first to last of the unit circle, as rounded next to these walls. What stands at the
// profile's end is its first point.
void arc_to(std::vector<Flat>& profile, std::size_t first, std::size_t last, Flat wall, Flat radius) {
  const auto ring = circle();
  for (std::size_t i = profile.empty() ? first : first + 1; i <= last; ++i) {
    const Flat& point = ring[i % ring.size()];
    profile.push_back({rounded_at(wall.x, radius.x, point.x), rounded_at(wall.y, radius.y, point.y)});
  }
}

void line_to(std::vector<Flat>& profile, Flat end) {
  const Flat start = profile.back();
  for (const double part : {1.0 / 3, 2.0 / 3})
    profile.push_back({start.x + part * (end.x - start.x), start.y + part * (end.y - start.y)});
  profile.push_back(end);
}

// A rounded box is a sphere whose eighths are pulled apart to the corners of a box. Between them its turn
// about z and its profile have straight pieces: points that are out as a sphere's, but move along a wall. At
// the poles they are the sides of the flat faces below and above.
struct Pulled {
  Flat out;
  Flat wall;
};

constexpr double kThirds[] = {-1, -1.0 / 3, 1.0 / 3, 1};

// Four times a straight piece and two arcs, beginning at (1, 0).
std::vector<Pulled> pulled_ring() {
  constexpr Flat walls[] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  const auto ring = circle();
  std::vector<Pulled> points;
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    const Flat &wall = walls[quarter], &out = ring[6 * quarter];
    for (std::size_t k = 0; k < 3; ++k)
      points.push_back({out, out.x == 0 ? Flat{wall.x * kThirds[k], wall.y} : Flat{wall.x, wall.y * kThirds[k]}});
    for (std::size_t k = 0; k < 6; ++k) points.push_back({ring[6 * quarter + k], wall});
  }
  return points;
}

// From pole to pole; walls below and above.
std::vector<Pulled> pulled_profile() {
  const auto ring = circle();
  std::vector<Pulled> points;
  for (std::size_t k = 18; k < 24; ++k) points.push_back({ring[k], {0, -1}});
  for (std::size_t k = 0; k < 3; ++k) points.push_back({ring[0], {0, kThirds[k]}});
  for (std::size_t k = 0; k <= 6; ++k) points.push_back({ring[k], {0, 1}});
  return points;
}

std::array<float, 3> rounded_point(const std::array<double, 3>& edge, const std::array<double, 3>& out,
                                   const std::array<double, 3>& wall) {
  std::array<float, 3> point;
  for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = placed(rounded_at(wall[axis], 2 * edge[axis], out[axis]));
  return point;
}

// Adds the patch of point(i, j), unless it has no extent in one direction.
void add_patch(std::vector<wire::Patch>& patches, const auto& point) {
  wire::Patch patch;
  bool along_u = false, along_v = false;
  for (std::size_t k = 0; k < 16; ++k) {
    patch.points[k] = point(k % 4, k / 4);
    along_u |= patch.points[k] != patch.points[k - k % 4];
    along_v |= patch.points[k] != patch.points[k % 4];
  }
  if (along_u && along_v) patches.push_back(patch);
}

}  // namespace

std::vector<wire::Patch> make_box() {
  constexpr std::array<float, 4> at = {0, 1.0f / 3, 2.0f / 3, 1};
  std::vector<wire::Patch> patches;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      const std::size_t u = (axis + (far ? 1 : 2)) % 3, v = (axis + (far ? 2 : 1)) % 3;
      wire::Patch& patch = patches.emplace_back();
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

std::vector<wire::Patch> make_sphere() {
  std::vector<Flat> profile;  // from the south pole to the north pole
  arc_to(profile, 18, 30, {0, 0}, {1, 1});
  return revolve(profile);
}

std::vector<wire::Patch> make_cylinder() { return make_cone(1); }

std::vector<wire::Patch> make_cone(double top) {
  std::vector<Flat> profile = {{0, -1}};
  line_to(profile, {1, -1});
  line_to(profile, {top, 1});
  if (top > 0) line_to(profile, {0, 1});
  return revolve(profile);
}

std::vector<wire::Patch> make_torus(double tube) {
  std::vector<Flat> profile;
  arc_to(profile, 0, 24, {1, 0}, {2 * tube, 1});
  return revolve(profile);
}

std::vector<wire::Patch> make_capsule(double ends) {
  std::vector<Flat> profile;
  arc_to(profile, 18, 24, {0, -1}, {1, 2 * ends});
  if (ends < 0.5) line_to(profile, {1, 1 - 2 * ends});
  arc_to(profile, 24, 30, {0, 1}, {1, 2 * ends});
  return revolve(profile);
}

std::vector<wire::Patch> make_disc(double rim) {
  std::vector<Flat> profile = {{0, -1}};
  line_to(profile, {1 - 2 * rim, -1});
  arc_to(profile, 18, 30, {1, 0}, {2 * rim, 1});
  line_to(profile, {0, 1});
  return revolve(profile);
}

std::vector<wire::Patch> make_rounded_box(const std::array<double, 3>& edge) {
  const auto ring = pulled_ring();
  const auto profile = pulled_profile();
  std::vector<wire::Patch> patches;
  for (std::size_t curve = 0; curve + 3 < profile.size(); curve += 3)
    for (std::size_t piece = 0; piece < ring.size(); piece += 3)
      add_patch(patches, [&](std::size_t i, std::size_t j) {
        const Pulled &around = ring[(piece + i) % ring.size()], &along = profile[curve + j];
        const double out = along.out.x;
        return rounded_point(edge, {out * around.out.x, out * around.out.y, along.out.y},
                             {around.wall.x, around.wall.y, along.wall.y});
      });
  for (const double z : {-1, 1})
    add_patch(patches, [&](std::size_t i, std::size_t j) {
      if (z < 0) std::swap(i, j);
      return rounded_point(edge, {0, 0, z}, {kThirds[i], kThirds[j], z});
    });
  return patches;
}

}  // namespace mars::modeler
