// What FBX and COLLADA files have besides meshes and skins, as a glTF file has it: where their nodes are at any time,
// cameras and lights.
#pragma once

#include <filesystem>
#include <string>

#include "host/content/importer/gltf/gltf_scene.h"

namespace mars::importer {

// Nodes have the numbers of scene_nodes(), cameras and lights nodes of their own behind these. Keys are joined by
// straight lines and the shortest turns, as Assimp gives them. Refuses what LoadedScene refuses, and an animation that
// the file has not.
GltfScene read_scene_motion(const std::filesystem::path& path, const std::string& animation);

}  // namespace mars::importer
