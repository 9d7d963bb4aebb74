// Which surface lies under a pixel. Rays are met with boxes round each patch and meshlet first, so that of a million
// triangles few are looked at; patches are diced only where a ray meets their box.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "host/studio/stage/moments.h"
#include "host/studio/stage/screen.h"

namespace mars::studio {

inline constexpr int kPatchSteps = 8;  // in which a patch is diced, each way

// Of the unit cube's shapes: points, three corners a triangle.
struct Triangles {
  std::vector<std::array<float, 3>> points;
  std::vector<std::uint32_t> corners;
};

// Adds the patch in kPatchSteps steps each way, or in fewer.
void add_diced(const wire::Patch& patch, int steps, Triangles& triangles);

struct Hit {
  std::size_t segment;
  glm::dvec3 place;
  std::optional<std::uint32_t> bone{};  // of a skin, what the place follows most: its number in the segment's list
};

// The nearest surface on the ray, of segments that count.
std::optional<Hit> first_hit(const Moments& moments, const Ray& ray,
                             const std::function<bool(std::size_t segment)>& counts);

}  // namespace mars::studio
