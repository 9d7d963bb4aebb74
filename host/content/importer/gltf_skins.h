// What Assimp 5.2 does not give of a glTF file's nodes: which node a bone is (Assimp has names alone, and several nodes
// may have one), and which of the nodes that share a mesh have a skin. FBX and COLLADA have the same (scene_nodes.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/content/importer/gltf/gltf_json.h"

namespace mars::importer {

struct GltfNode {
  std::string name;  // the node's, else its mesh's; "": neither has one
  std::vector<std::size_t> children;
  std::optional<std::size_t> skin;
};

struct GltfSkins {
  std::vector<GltfNode> nodes;                  // all of the file's
  std::vector<std::size_t> roots;               // of the scene
  std::vector<std::vector<std::size_t>> skins;  // each the numbers of its joints' nodes, in the order of Assimp's bones
  glm::dmat4 above{1};                          // what the roots stand in
  bool is_by_mesh = false;                      // of FBX and COLLADA: a skin has the number of its mesh
};

// Refuses skins that Assimp reads wrongly.
GltfSkins gltf_skins(const std::filesystem::path& path, const Tree& gltf);

}  // namespace mars::importer
