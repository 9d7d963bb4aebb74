#include "tests/node/shape/patches.h"

#include <algorithm>
#include <cmath>

#include "node/geometry/scene.h"

namespace mars::shape {
namespace {

constexpr std::size_t kFirst[] = {0, 3, 12, 0}, kStride[] = {1, 4, 1, 4};

std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

}  // namespace

Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

namespace {

wire::FilmSettings settings_of(std::int32_t width, std::int32_t height) {
  wire::FilmSettings settings{};
  settings.width = static_cast<std::uint32_t>(width);
  settings.height = static_cast<std::uint32_t>(height);
  return settings;
}

}  // namespace

Projection projection(std::int32_t width, std::int32_t height, double focal, double near, double far) {
  return geometry::projection_of({{}, focal, near, far}, settings_of(width, height));
}

Projection parallel_projection(std::int32_t width, std::int32_t height, double shown, double near, double far) {
  return geometry::projection_of({{}, 2 / shown, near, far, 1, 0.1, -0.2, wire::Projection::orthographic},
                                 settings_of(width, height));
}

EyePatch random_patch(Random& random, const Vec3& middle, double size) {
  return make_patch([&](int, int) {
    Vec3 place = middle;
    for (double& p : place) p += random.real(-size, size);
    return place;
  });
}

EyePatch sphere_octant(const Vec3& middle, double radius) {
  return make_patch([&](int i, int j) {
    const double around = radius * kQuarter[j][0];
    return Vec3{middle[0] + around * kQuarter[i][1], middle[1] + radius * kQuarter[j][1],
                middle[2] + around * kQuarter[i][0]};
  });
}

EyePatch cone_quarter(const Vec3& middle, double top, double height) {
  return make_patch([&](int i, int j) {
    const double radius = 1 + (top - 1) * j / 3;
    return Vec3{middle[0] + radius * kQuarter[i][1], middle[1] + height * j / 3, middle[2] + radius * kQuarter[i][0]};
  });
}

EyePatch swapped(const EyePatch& patch) {
  EyePatch out;
  for (std::size_t k = 0; k < 16; ++k) std::copy_n(patch.point[k], 3, out.point[4 * (k % 4) + k / 4]);
  return out;
}

EyePatch turned(const EyePatch& patch) {
  EyePatch out;
  for (std::size_t k = 0; k < 16; ++k) std::copy_n(patch.point[k], 3, out.point[15 - k]);
  return out;
}

Vec3 point_at(const Curve& curve, double t) {
  const auto b = bernstein(t);
  Vec3 out{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) out[axis] += b[k] * curve.point[k][axis];
  return out;
}

Vec3 point_at(const EyePatch& patch, double u, double v) {
  const auto across = bernstein(u), up = bernstein(v);
  Vec3 out{};
  for (std::size_t k = 0; k < 16; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) out[axis] += across[k % 4] * up[k / 4] * patch.point[k][axis];
  return out;
}

std::array<double, 2> on_screen(const Projection& p, const Vec3& place) {
  const double spread = p.parallel ? 1 : -place[2];
  return {p.center[0] + p.scale * place[0] / spread, p.center[1] - p.scale * place[1] / spread};
}

std::array<std::array<float, 3>, 4> side_points(const EyePatch& patch, Side side) {
  const auto s = static_cast<std::size_t>(side);
  std::array<std::array<float, 3>, 4> points;
  for (std::size_t i = 0; i < 4; ++i) std::copy_n(patch.point[kFirst[s] + i * kStride[s]], 3, points[i].begin());
  return points;
}

void set_side_points(EyePatch& patch, Side side, const std::array<std::array<float, 3>, 4>& points) {
  const auto s = static_cast<std::size_t>(side);
  for (std::size_t i = 0; i < 4; ++i) std::copy_n(points[i].begin(), 3, patch.point[kFirst[s] + i * kStride[s]]);
}

}  // namespace mars::shape
