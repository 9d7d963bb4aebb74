// The nodes of FBX and COLLADA files, numbered as glTF's are, from their root on, each after the one above it.
#pragma once

#include <assimp/scene.h>

#include <cstddef>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <map>
#include <string>
#include <vector>

#include "host/content/importer/gltf_skins.h"

namespace mars::importer {

inline constexpr std::size_t kMostNodes = 1'000'000;

// Assimp writes what turns or scales an FBX node about a point of its own as nodes above it, which are no joints.
inline constexpr const char* kPivot = "_$AssimpFbx$_";  // behind the node's own name
bool is_pivot(const std::string& name);

struct SceneNodes {
  std::vector<const aiNode*> nodes;
  std::vector<std::size_t> parents;            // modeler::kNone of the root
  glm::dmat4 root;                             // the root's matrix, to metres with y up: FBX says its unit and axes
  std::map<std::string, std::size_t> numbers;  // by name; of several nodes with a name, the first
};

// Refuses more than a million nodes.
SceneNodes scene_nodes(const std::filesystem::path& path, const aiScene& scene);

// As gltf_skins(); a mesh's bones are `skins` at its own number.
GltfSkins scene_skins(const aiScene& scene, const SceneNodes& nodes);

}  // namespace mars::importer
