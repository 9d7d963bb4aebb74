// What a scene of Assimp's holds besides its meshes: a model takes none of it.
#pragma once

#include <string>
#include <vector>

struct aiScene;

namespace mars::importer {

// "19 bones (...)", ... with what to do about it. Lists nodes only if `has_tree`: where the file's own nodes move.
// `set_material` as in MeshOptions.
std::vector<std::string> unread_parts(const aiScene& scene, bool has_tree, const std::string& set_material);

}  // namespace mars::importer
