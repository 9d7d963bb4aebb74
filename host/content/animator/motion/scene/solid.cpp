#include "host/content/animator/motion/scene/solid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/pose/joint_frames.h"
#include "host/content/animator/motion/body/surface.h"
#include "host/content/elementary/elementary.h"

namespace mars::motion {
namespace {

constexpr int kFineGrid = 9;           // points along each side of a patch
constexpr std::size_t kTogether = 32;  // triangles

glm::dvec3 nearest_on(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& place) {
  const glm::dvec3 way = b - a;
  const double length = glm::dot(way, way);
  return length > 0 ? a + std::clamp(glm::dot(place - a, way) / length, 0.0, 1.0) * way : a;
}

double distance_to(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& from) {
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  double least = 1e300;
  bool is_above = glm::dot(normal, normal) > 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 3];
    is_above = is_above && glm::dot(glm::cross(b - a, from - a), normal) >= 0;
    least = std::min(least, glm::distance(from, nearest_on(a, b, from)));
  }
  return is_above ? std::abs(glm::dot(from - corners[0], normal)) / glm::length(normal) : least;
}

// The solid angle of a triangle (van Oosterom, Strackee 1983).
double angle_of(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& from) {
  const glm::dvec3 a = corners[0] - from, b = corners[1] - from, c = corners[2] - from;
  const double x = glm::length(a), y = glm::length(b), z = glm::length(c);
  return 2 * elementary::atan2(glm::dot(a, glm::cross(b, c)),
                               x * y * z + glm::dot(a, b) * z + glm::dot(b, c) * x + glm::dot(c, a) * y);
}

// Neighbours in space mostly come near each other: by the bits of their places in the box, one axis after the other.
std::uint64_t place_in_order(const glm::dvec3& place, const glm::dvec3& low, const glm::dvec3& high) {
  constexpr int kBits = 10;
  std::uint64_t order = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = high[axis] - low[axis];
    const double part = size > 0 ? (place[axis] - low[axis]) / size : 0;
    const auto cell = static_cast<std::uint64_t>(std::clamp(part, 0.0, 1.0) * ((1 << kBits) - 1));
    for (int bit = 0; bit < kBits; ++bit) order |= (cell >> bit & 1) << (3 * bit + axis);
  }
  return order;
}

}  // namespace

Solid::Solid(const animator::Film& film, std::size_t actor, std::uint32_t frame, const modeler::Axes& seen_from) {
  const animator::ActorState state = animator::state_at(film, actor, frame);
  const Surface surface = surface_of(
      film.model_of(actor), [&](std::size_t joint) { return animator::seen_from(seen_from, state.joints[joint]); },
      kFineGrid);
  std::vector<Triangle> triangles(surface.triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      triangles[i][k] = surface.points[surface.triangles[i][k]].place;
      low_ = glm::min(low_, triangles[i][k]);
      high_ = glm::max(high_, triangles[i][k]);
    }
  std::ranges::stable_sort(triangles, {}, [&](const Triangle& triangle) {
    return place_in_order((triangle[0] + triangle[1] + triangle[2]) / 3.0, low_, high_);
  });
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (i % kTogether == 0) patches_.emplace_back();
    patches_.back().triangles.push_back(triangles[i]);
  }
  for (Patch& patch : patches_) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const Triangle& triangle : patch.triangles)
      for (const glm::dvec3& corner : triangle) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
      }
    patch.middle = 0.5 * (low + high);
    patch.radius = 0.5 * glm::distance(low, high);
  }
}

double Solid::distance(const glm::dvec3& from) const {
  double least = 1e300;
  for (const Patch& patch : patches_) {
    if (glm::distance(from, patch.middle) - patch.radius >= least) continue;
    for (const Triangle& triangle : patch.triangles) least = std::min(least, distance_to(triangle, from));
  }
  return least;
}

bool Solid::holds(const glm::dvec3& place) const {
  if (glm::any(glm::lessThan(place, low_)) || glm::any(glm::greaterThan(place, high_))) return false;
  double around = 0;
  for (const Patch& patch : patches_)
    for (const Triangle& triangle : patch.triangles) around += angle_of(triangle, place);
  return std::abs(around) > 2 * std::numbers::pi;
}

}  // namespace mars::motion
