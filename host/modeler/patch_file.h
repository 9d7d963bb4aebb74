// Patch files (.bpt): text, first the number of patches, then for each its two degrees, `3 3`, and its 16
// control points, `x y z`, along u first. `mars import` makes a model of one joint from them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/modeler/model.h"

namespace mars::host {

// Patches scaled from the bounds of their control points into the unit cube; the bounds as sbb restore them.
struct PatchFile {
  std::vector<node::Patch> patches;
  Box bounds;
};

PatchFile read_patch_file(const std::filesystem::path& path);

// Reads the patch file `from` and writes a model file `to` of one joint named `joint`, or as the file if that
// is
// "". Tells what was written in one line.
std::string import_patches(const std::filesystem::path& from, const std::filesystem::path& to,
                           std::string joint);

}  // namespace mars::host
