// Patch files (.bpt): text, first the number of patches, then for each its two degrees, `3 3`, and its 16
// control points, `x y z`, along u first.
#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <vector>

#include "host/content/modeler/joint.h"
#include "node/wire/film_parts.h"

namespace mars::modeler {

// Patches scaled from the bounds of their control points into the unit cube; the bounds as sbb restore them.
struct PatchFile {
  std::vector<wire::Patch> patches;
  Box bounds;
  glm::dvec3 extent;  // of the points; 0 where they are flat
};

// Each point is first multiplied by `placing`.
PatchFile read_patch_file(const std::filesystem::path& path, const glm::dmat3& placing = glm::dmat3(1));

}  // namespace mars::modeler
