#include "tests/bench/peers/light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mars::bench {
namespace {

constexpr int kTurns = 90;  // that are tried, one degree each

using Axis = std::array<float, 3>;

float dot(const Axis& a, const Axis& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Axis cross(const Axis& a, const Axis& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Axis unit(const Axis& a) {
  const float length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

LightAxes turned(const LightAxes& axes, int turn) {
  const float angle = static_cast<float>(turn) * std::numbers::pi_v<float> / 180;
  const float c = std::cos(angle), s = std::sin(angle);
  LightAxes out = axes;
  for (std::size_t k = 0; k < 3; ++k) {
    out.axis[0][k] = c * axes.axis[0][k] + s * axes.axis[1][k];
    out.axis[1][k] = c * axes.axis[1][k] - s * axes.axis[0][k];
  }
  return out;
}

float window(const LightAxes& axes, const std::vector<Outline>& outlines) {
  LightBox all = light_box(axes, outlines[0], kStill);
  for (const Outline& outline : outlines) all = round(all, light_box(axes, outline, kStill));
  return std::max(all.high[0] - all.low[0], all.high[1] - all.low[1]);
}

}  // namespace

LightAxes light_axes(const MeshHead& head, const std::vector<Outline>& outlines) {
  const Axis& toward = head.to_light;
  const Axis across = unit(cross(toward, std::abs(toward[0]) < 0.5f ? Axis{1, 0, 0} : Axis{0, 1, 0}));
  const LightAxes any{{across, cross(toward, across), toward}};
  LightAxes best = any;
  float least = std::numeric_limits<float>::infinity();
  for (int turn = 0; turn < kTurns && !outlines.empty(); ++turn) {
    const LightAxes axes = turned(any, turn);
    if (const float size = window(axes, outlines); size < least) best = axes, least = size;
  }
  return best;
}

LightBox light_box(const LightAxes& axes, const Outline& outline, const Motion& m) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  LightBox box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const auto& p : outline) {
    Axis q;
    for (std::size_t r = 0; r < 3; ++r) q[r] = m[r][0] * p[0] + m[r][1] * p[1] + m[r][2] * p[2] + m[r][3];
    for (std::size_t k = 0; k < 3; ++k) {
      const float at = dot(axes.axis[k], q);
      box.low[k] = std::min(box.low[k], at), box.high[k] = std::max(box.high[k], at);
    }
  }
  return box;
}

LightBox round(const LightBox& a, const LightBox& b) {
  LightBox box = a;
  for (std::size_t k = 0; k < 3; ++k)
    box.low[k] = std::min(a.low[k], b.low[k]), box.high[k] = std::max(a.high[k], b.high[k]);
  return box;
}

bool may_shade(const LightBox& caster, const LightBox& receiver, float sun) {
  const float drop = caster.high[2] - receiver.low[2];
  if (drop <= 0) return false;
  for (std::size_t k = 0; k < 2; ++k)
    if (caster.low[k] - sun * drop > receiver.high[k] || receiver.low[k] > caster.high[k] + sun * drop) return false;
  return true;
}

ShadedAreas::ShadedAreas(const Mesh& mesh, float sun)
    : sun_(sun), mover_(outlines_of(mesh, true)), axes_(light_axes(mesh.head, {})) {
  for (const Outline& outline : outlines_of(mesh, false))
    receivers_.push_back({light_box(axes_, outline, kStill), cover(outline, mesh.head, kStill)});
}

std::vector<Area> ShadedAreas::of(const Motion& motion) const {
  std::vector<Area> areas;
  if (mover_.empty()) return areas;
  LightBox caster = light_box(axes_, mover_[0], motion);
  for (const Outline& outline : mover_) caster = round(caster, light_box(axes_, outline, motion));
  for (const Receiver& receiver : receivers_)
    if (may_shade(caster, receiver.box, sun_)) areas.push_back(receiver.area);
  return areas;
}

}  // namespace mars::bench
