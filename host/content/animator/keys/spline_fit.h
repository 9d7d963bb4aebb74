// Few keys of splines (channel.h) for curves that are known at every frame: captured or computed motion, made such that
// a person can edit it.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace mars::animator {

struct DenseCurve {
  std::vector<glm::dvec3> values;  // one a frame, two at least
  // How far a value is off in that frame, as a share of what is allowed.
  std::function<double(std::size_t frame, const glm::dvec3& value)> error;
  double grain;  // values become multiples of it
};

struct FittedKey {
  std::size_t at;  // frame
  glm::dvec3 value;
  std::optional<glm::dvec3> in, out;  // where none, slope_at() is good enough
};

// For each curve keys on its first and last frame, and between them so that no frame's error is above 1. The curves
// share as few frames as they need together, and each has keys only at those that it needs: poses stay together. All
// curves have as many frames.
std::vector<std::vector<FittedKey>> fit_splines(std::span<const DenseCurve> curves);

}  // namespace mars::animator
