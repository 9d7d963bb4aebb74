// Patches, projections and random numbers for the node's tests, and surfaces evaluated in double precision.
#pragma once

#include <array>
#include <cstdint>
#include <random>

#include "node/shape/bezier.h"

namespace mars::shape {

// The same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}

  double real(double low, double high) { return low + (high - low) * (engine_() / 4294967296.0); }
  // low..high, both included.
  std::int32_t whole(std::int32_t low, std::int32_t high) {
    return low + static_cast<std::int32_t>(engine_() % (static_cast<std::uint32_t>(high - low) + 1u));
  }
  std::uint32_t bits() { return static_cast<std::uint32_t>(engine_()); }

 private:
  std::mt19937 engine_;
};

using Vec3 = std::array<double, 3>;

Vec3 operator-(const Vec3& a, const Vec3& b);
double dot(const Vec3& a, const Vec3& b);
Vec3 cross(const Vec3& a, const Vec3& b);
double length(const Vec3& a);

// Every patch into as many steps; and as films of one sample a pixel ask for.
inline Dicing steps(int rate) { return {rate, {}}; }
inline Dicing adaptive(std::uint32_t samples = 1) { return {0, tolerances_of(samples)}; }

// The eye's view on a picture: `focal` = 1 / tan(half the vertical field of view).
Projection projection(std::int32_t width, std::int32_t height, double focal, double near = 0.1, double far = 1000);
// A picture that shows `shown` of the height everywhere, a little beside the view axis.
Projection parallel_projection(std::int32_t width, std::int32_t height, double shown, double near = 0.1,
                               double far = 1000);

// Control points place(i, j), i along u.
template <typename Place>
EyePatch make_patch(const Place& place) {
  EyePatch patch;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const Vec3 p = place(i, j);
      for (std::size_t axis = 0; axis < 3; ++axis) patch.point[4 * j + i][axis] = static_cast<float>(p[axis]);
    }
  return patch;
}

// All control points within `size` of `middle` along each axis.
EyePatch random_patch(Random& random, const Vec3& middle, double size);

// An eighth of a sphere round `middle`: u runs east, v runs north to the pole, where the patch collapses.
EyePatch sphere_octant(const Vec3& middle, double radius);
// A quarter of a cone's or cylinder's side: radius 1 below, `top` above, `height` along y.
EyePatch cone_quarter(const Vec3& middle, double top, double height);
// Quarter circle's control points, radius 1.
inline constexpr double kArc = 0.5522847498307936;
inline constexpr double kQuarter[4][2] = {{1, 0}, {1, kArc}, {kArc, 1}, {0, 1}};

// u becomes v: the outside becomes the inside.
EyePatch swapped(const EyePatch& patch);
// Turned half round in parameters: u and v both run the other way.
EyePatch turned(const EyePatch& patch);

Vec3 point_at(const Curve& curve, double t);
Vec3 point_at(const EyePatch& patch, double u, double v);

// Screen place in pixels.
std::array<double, 2> on_screen(const Projection& projection, const Vec3& place);

// The four control points of a side, along u or v.
std::array<std::array<float, 3>, 4> side_points(const EyePatch& patch, Side side);
void set_side_points(EyePatch& patch, Side side, const std::array<std::array<float, 3>, 4>& points);

inline constexpr Side kSides[] = {Side::bottom, Side::right, Side::top, Side::left};

}  // namespace mars::shape
