// The nodes of Assimp's scene, in a list, each with its matrix in the whole file's axes and, of scenes, its skin.
#pragma once

#include <assimp/scene.h>

#include <glm/mat4x4.hpp>
#include <span>
#include <string>
#include <vector>

#include "host/content/importer/gltf_skins.h"
#include "host/content/modeler/joint.h"

namespace mars::importer {

struct PlacedNode {
  const aiNode* node;
  std::size_t parent;  // an index before this one's; kNone: the scene's root
  glm::dmat4 matrix;   // from the node's axes to the file's
  std::string name;    // "": it has none
  std::optional<std::size_t> skin;
  std::size_t number = modeler::kNone;  // of the file's node; kNone: there is no such node
  bool is_pivot = false;                // no joint: it belongs to the node below it
};

struct NodeTree {
  std::vector<PlacedNode> nodes;
  std::vector<glm::dmat4> by_number;  // of scenes: the matrices of the file's nodes that stand in the scene

  const glm::dmat4& above(const PlacedNode& node) const;  // what the node's own matrix was multiplied to
};

// Of scenes with their skins; without them every node is nameless. `rest`: how each of the file's nodes stands in the
// one above it; empty: as the file says. Refuses more than a million nodes in failures that name `path`.
NodeTree node_tree(const std::filesystem::path& path, const aiScene& scene, const GltfSkins* skins,
                   std::span<const glm::dmat4> rest);

}  // namespace mars::importer
