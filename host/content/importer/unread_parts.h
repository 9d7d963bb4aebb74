// What a scene of Assimp's holds besides its meshes: a model takes none of it.
#pragma once

#include <assimp/scene.h>

#include <string>
#include <vector>

#include "host/content/importer/material_reader.h"

namespace mars::importer {

// "2 animations (...)", ... with what to do about it. Textures of `materials` stand in them or are kept. `set_material`
// as in MeshOptions. A film has animations, cameras and lights, and other remedies.
std::vector<std::string> unread_parts(const aiScene& scene, const MaterialReader& materials,
                                      const std::string& set_material, bool in_film);

}  // namespace mars::importer
