#include "host/content/importer/motions/spindles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "host/content/elementary/elementary.h"

namespace mars::importer {
namespace {

constexpr int kSides = 6;                              // of a spindle
constexpr double kWaist = 0.16;                        // of its length: where it is thickest
constexpr double kThickness = 0.13;                    // its radius there, of its length
constexpr double kThinnest = 0.006, kThickest = 0.03;  // of the skeleton's size
constexpr double kKnob = 0.012;                        // of the size: radius of a joint that carries nothing

// Two pyramids on one base, from the joint to `end`.
void add_spindle(Spindles& all, const glm::dvec3& begin, const glm::dvec3& end, double radius, double waist) {
  const glm::dvec3 along = glm::normalize(end - begin);
  const glm::dvec3 least = std::abs(along.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(along, least)), v = glm::cross(along, u);
  const std::size_t first = all.vertices.size();
  all.vertices.push_back(begin);
  all.vertices.push_back(end);
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    all.vertices.push_back(begin + waist * (end - begin) +
                           radius * (elementary::cos(angle) * u + elementary::sin(angle) * v));
  }
  for (std::size_t i = 0; i < kSides; ++i) {
    const std::size_t one = first + 2 + i, other = first + 2 + (i + 1) % kSides;
    all.faces.push_back({first, other, one});
    all.faces.push_back({first + 1, one, other});
  }
}

}  // namespace

Spindles spindles_of(const std::vector<glm::dvec3>& ends, double size) {
  Spindles all;
  std::vector<glm::dvec3> drawn;
  for (const glm::dvec3& end : ends) {
    const double length = glm::length(end);
    const auto same = [&](const glm::dvec3& other) { return glm::length(other - end) <= kThinnest * size; };
    if (length <= kThinnest * size || std::ranges::any_of(drawn, same)) continue;
    drawn.push_back(end);
    add_spindle(all, glm::dvec3(0), end, std::clamp(kThickness * length, kThinnest * size, kThickest * size), kWaist);
  }
  if (drawn.empty() && ends.empty())
    add_spindle(all, glm::dvec3(0, 0, -kKnob * size), glm::dvec3(0, 0, kKnob * size), kKnob * size, 0.5);
  return all;
}

}  // namespace mars::importer
