#include "node/shadow/light_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace mars::shadow {
namespace {

using Vector = std::array<double, 3>;

constexpr double kPi = 3.14159265358979323846;
// Of lights with a place, a step is this tangent: fine enough for a float, coarse enough that most triangles are small
// (kernels.h).
constexpr double kTangentStep = 1.0 / (1 << 20);
constexpr double kFloatError = 1.0 / (1 << 20);  // of a place's distance
constexpr double kDepthError = 1.0 / (1 << 23);  // of 1 / w, in 1 / near
constexpr double kWidestFace = 0.70710678;       // cosine of half a face's angle

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector unit(const Vector& a) {
  const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  return length > 0 ? Vector{a[0] / length, a[1] / length, a[2] / length} : Vector{0, 0, 1};
}

Vector vector_of(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

// Sine for 0..pi/2, to 1e-9, and cosine, with + - * / alone.
double sine(double x) {
  double term = x, sum = x;
  for (int k = 1; k <= 7; ++k) sum += term *= -x * x / ((2 * k) * (2 * k + 1));
  return sum;
}

struct Turn {
  double sine, cosine;
};

// Of `share` of a full turn, 0..1.
Turn turn(double share) {
  const double quarters = share * 4;
  const int quarter = std::min(static_cast<int>(quarters), 3);
  const double rest = (quarters - quarter) * kPi / 2;
  const double s = sine(rest), c = sine(kPi / 2 - rest);
  switch (quarter) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

// Digits of `number` to `base`, mirrored at the point: evenly spread in 0..1 (van der Corput's sequence).
double mirrored(std::uint32_t number, std::uint32_t base) {
  double value = 0, digit = 1.0 / base;
  for (; number > 0; number /= base, digit /= base) value += (number % base) * digit;
  return value;
}

// Point i of an evenly bright unit disc: Hammersley's points on a square, its rings as wide as the disc's are.
std::array<double, 2> disc_point(std::uint32_t i) {
  const double ring = std::sqrt((i + 0.5) / kLightPoints);
  const Turn around = turn(mirrored(i, 2));
  return {ring * around.cosine, ring * around.sine};
}

// The part t - sin t cos t of pi/2 that lies within sin t of a ball's middle, where its density is 1 / sqrt(1 - r^2):
// such a ball is an evenly bright disc from wherever it is seen.
double ball_radius(double part) {
  double low = 0, high = kPi / 2;
  for (int k = 0; k < 40; ++k) {
    const double t = (low + high) / 2;
    (t - sine(t) * sine(kPi / 2 - t) < part * kPi / 2 ? low : high) = t;
  }
  return sine(low);
}

Vector ball_point(std::uint32_t i) {
  const double height = 2 * (i + 0.5) / kLightPoints - 1, ring = std::sqrt(1 - height * height);
  const Turn around = turn(mirrored(i, 2));
  const double radius = ball_radius((mirrored(i, 3) + 0.5 / kLightPoints));
  return {radius * ring * around.cosine, radius * ring * around.sine, radius * height};
}

// Two unit vectors across `axis`. One is also across the view axis where that is another: neighbouring pixels of a
// surface that is seen edge-on lie far apart along it, and boxes round them are small then.
std::array<Vector, 2> across(const Vector& axis) {
  constexpr double kSame = 0.99;
  const Vector other = std::abs(axis[2]) < kSame ? Vector{0, 0, 1} : Vector{1, 0, 0};
  const Vector u = unit(cross(other, axis));
  return {u, cross(axis, u)};
}

void put(const Vector& from, float* to) {
  for (std::size_t k = 0; k < 3; ++k) to[k] = static_cast<float>(from[k]);
}

// From the point (x, y) of the disc, in tangents of the angle to the middle.
LightView far_view(const Vector& axis, double x, double y, double step) {
  auto [u, v] = across(axis);
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] -= x * axis[k];
    v[k] -= y * axis[k];
  }
  LightView view{};
  put(u, view.u);
  put(v, view.v);
  put(axis, view.axis);
  view.per_step = static_cast<float>(1 / step);
  return view;
}

LightView near_view(const Vector& axis, const Vector& place, double nearest, bool is_face) {
  const auto [u, v] = across(axis);
  LightView view{};
  put(u, view.u);
  put(v, view.v);
  put(axis, view.axis);
  put(place, view.place);
  view.per_step = static_cast<float>(1 / kTangentStep);
  view.nearest = static_cast<float>(nearest);
  view.has_place = 1;
  view.is_face = is_face ? 1 : 0;
  return view;
}

// Of places that are drawn, from the eye.
double farthest_place(const shape::Projection& p) {
  return p.parallel ? std::sqrt(double{p.far} * p.far + double{p.radius} * p.radius) : double{p.far} / p.corner;
}

// The step is a pixel at the nearest distance that is drawn, of parallel projection a part of a pixel, but so that the
// farthest fits the grid.
void see_from_afar(const geometry::EyeLight& light, const shape::Projection& projection, LightViews& out) {
  constexpr double kMostSteps = 1 << 28;
  constexpr double kParallelStep = 1.0 / 256;  // of a pixel, as places are snapped
  const double finest = projection.parallel ? kParallelStep : double{projection.near};
  const double scale = projection.scale * std::max(1.0, double{projection.squeeze});
  const double step = std::max(finest / scale, farthest_place(projection) / kMostSteps);
  const Vector axis = unit(vector_of(light.vector));
  out.faces = 1;
  out.middle = {far_view(axis, 0, 0, step)};
  for (std::uint32_t i = 0; i < out.points; ++i) {
    const auto [x, y] = out.points > 1 ? disc_point(i) : std::array<double, 2>{};
    out.views.push_back(far_view(axis, light.size * x, light.size * y, step));
  }
  out.spread = static_cast<float>(light.size / step);
  out.frame.everywhere += static_cast<float>(2 * step);
  out.frame.by_depth = 0;
}

void see_from_place(const geometry::EyeLight& light, const shape::Projection& projection, LightViews& out) {
  constexpr std::array<Vector, 6> kAxes{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  const bool one = light.kind == wire::LightKind::spot && light.cos_outer >= kWidestFace;
  const Vector way_of_spot = unit(vector_of(light.axis));
  const std::span<const Vector> axes = one ? std::span(&way_of_spot, 1) : std::span<const Vector>(kAxes);
  const double nearest = projection.near / 64.0;
  const Vector middle = vector_of(light.vector);
  out.faces = static_cast<std::uint32_t>(axes.size());
  for (const Vector& axis : axes) out.middle.push_back(near_view(axis, middle, nearest, !one));
  for (std::uint32_t i = 0; i < out.points; ++i) {
    Vector place = middle;
    const Vector way = out.points > 1 ? ball_point(i) : Vector{};
    for (std::size_t k = 0; k < 3; ++k) place[k] += light.size * way[k];
    for (const Vector& axis : axes) out.views.push_back(near_view(axis, place, nearest, !one));
  }
  out.spread = static_cast<float>(2 * std::numbers::sqrt2 * light.size / kTangentStep);
  out.frame.by_depth = static_cast<float>(2 * kTangentStep + kFloatError);
}

// But for what the light adds.
PointFrame point_frame(const shape::Projection& p) {
  PointFrame frame{};
  frame.scale = p.scale;
  frame.squeeze = p.squeeze;
  std::copy_n(p.center, 2, frame.center);
  for (std::size_t k = 0; k < 2; ++k) frame.origin[k] = static_cast<float>(p.origin[k]);
  frame.nothing = p.nothing;
  frame.parallel = p.parallel;
  const double pixel = 1.0 / (128.0 * p.scale * std::min(1.0, double{p.squeeze}));
  if (p.parallel) {
    frame.by_w = static_cast<float>(kFloatError);
    frame.everywhere = static_cast<float>(pixel + kFloatError * p.radius + kDepthError * p.far);
  } else {
    frame.by_w = static_cast<float>(pixel + kFloatError);
    frame.by_square = static_cast<float>(kDepthError / p.near);
  }
  return frame;
}

}  // namespace

LightViews light_views(const geometry::EyeLight& light, const shape::Projection& projection, LightViews room) {
  LightViews out = std::move(room);
  out.views.clear();
  out.middle.clear();
  out.size = light.size;
  out.points = light.size > 0 ? kLightPoints : 1;
  out.frame = point_frame(projection);
  if (light.kind == wire::LightKind::directional)
    see_from_afar(light, projection, out);
  else
    see_from_place(light, projection, out);
  return out;
}

}  // namespace mars::shadow
