// The map of a VRM file, which says which node is which limb of a person.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/content/importer/gltf/gltf_json.h"
#include "host/content/importer/limbs/find_limbs.h"

namespace mars::importer {

// Of VRM 1 (the extension VRMC_vrm) or VRM 0 (VRM): the map's joints are the numbers of the file's nodes. None where
// the file has no such map.
std::optional<LimbMap> limb_map(const Tree& gltf);

}  // namespace mars::importer
