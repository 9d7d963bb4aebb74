// Patch files (.bpt): text, first the number of patches, then for each its two degrees, `3 3`, and its 16
// control points, `x y z`, along u first.
#pragma once

#include <filesystem>
#include <vector>

#include "host/modeler/model.h"

namespace mars::host {

// Patches scaled from the bounds of their control points into the unit cube; the bounds as sbb restore them.
struct PatchFile {
  std::vector<node::Patch> patches;
  Box bounds;
};

PatchFile read_patch_file(const std::filesystem::path& path);

}  // namespace mars::host
