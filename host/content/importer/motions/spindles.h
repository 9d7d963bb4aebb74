// Bones to be seen: slender spindles, each of two pyramids on one base.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace mars::importer {

inline constexpr std::array<double, 3> kColorOfBones{0.86, 0.78, 0.62};

struct Spindles {
  std::vector<glm::dvec3> vertices;
  std::vector<std::array<std::size_t, 3>> faces;
};

// From a joint, in the middle, to each of `ends`; a knob if there is none. `size`: of the whole skeleton.
Spindles spindles_of(const std::vector<glm::dvec3>& ends, double size);

}  // namespace mars::importer
