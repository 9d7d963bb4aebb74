#include "host/content/animator/motion/body/stiff_legs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "host/content/animator/motion/body/curve.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr int kStiffLegRounds = 30;
constexpr double kDamping = 1e-6;  // of the leg squared: no way to where it helps nothing

// From the ankles to the hips, as the pelvis' limits let it stand.
std::array<glm::dvec3, 2> legs_of(const Body& body, const Stance& stance, Posture posture) {
  place_pelvis(body, stance, posture);
  std::array<glm::dvec3, 2> legs;
  for (const modeler::Side side : kSides)
    legs[index_of(side)] = frame_in(*body.model, posture, body.leg(side).hip).place - stance.feet[index_of(side)].ankle;
  return legs;
}

// The way along `line`, level, and up (z) on which both legs get their lengths: Gauss and Newton, damped.
glm::dvec3 to_both(const Body& body, const std::array<glm::dvec3, 2>& legs, const glm::dvec3& line) {
  double along = 0, up = 0;
  for (int round = 0; round < kStiffLegRounds; ++round) {
    double aa = 0, au = 0, uu = 0, a = 0, u = 0;
    for (const modeler::Side side : kSides) {
      const glm::dvec3 leg = legs[index_of(side)] + along * line + glm::dvec3(0, 0, up);
      const double length = body.leg(side).length(), left = (length * length - glm::dot(leg, leg)) / 2;
      const double by_along = glm::dot(leg, line), by_up = leg.z;
      aa += by_along * by_along;
      au += by_along * by_up;
      uu += by_up * by_up;
      a += by_along * left;
      u += by_up * left;
    }
    aa += kDamping * body.leg_length() * body.leg_length();
    const double area = aa * uu - au * au;
    if (!(area > 0)) break;
    along += (a * uu - u * au) / area;
    up += (u * aa - a * au) / area;
  }
  return along * line + glm::dvec3(0, 0, up);
}

bool stands(const Stance& stance) { return stance.feet[0].stands && stance.feet[1].stands; }

// Where both feet stand; (0, 0, 0) where the legs are beside each other or cannot reach.
glm::dvec3 shift_of(const Body& body, const Posture& start, const Stance& stance) {
  glm::dvec3 line = stance.feet[0].ankle - stance.feet[1].ankle;
  line.z = 0;
  if (glm::length(line) == 0) return glm::dvec3(0);
  const glm::dvec3 shift = to_both(body, legs_of(body, stance, start), glm::normalize(line));
  const double far = elementary::hypot(shift.x, shift.y);
  return far < body.leg_length() / 2 ? glm::dvec3(shift.x, shift.y, 0) : glm::dvec3(0);
}

// As high as the leg that stands, or the lower one of two, holds the pelvis.
double rise_of(const Body& body, const Posture& start, const Stance& stance) {
  const auto legs = legs_of(body, stance, start);
  double least = 1e300;
  for (const modeler::Side side : kSides) {
    if (!stance.feet[index_of(side)].stands) continue;
    const glm::dvec3& leg = legs[index_of(side)];
    const double length = body.leg(side).length(), level = std::min(elementary::hypot(leg.x, leg.y), length);
    least = std::min(least, std::sqrt(length * length - level * level) - leg.z);
  }
  return least;
}

}  // namespace

void stand_stiffly(const Body& body, const Posture& start, std::vector<Stance>& stances) {
  std::size_t from = 0;
  glm::dvec3 before = shift_of(body, start, stances[0]);
  stances[0].pelvis += before;
  for (std::size_t frame = 1; frame < stances.size(); ++frame) {
    if (!stands(stances[frame])) continue;
    const glm::dvec3 now = shift_of(body, start, stances[frame]);
    for (std::size_t at = from + 1; at <= frame; ++at)
      stances[at].pelvis += before + smooth(double(from), double(frame), double(at)) * (now - before);
    from = frame;
    before = now;
  }
  for (Stance& stance : stances) stance.pelvis.z += rise_of(body, start, stance);
}

}  // namespace mars::motion
