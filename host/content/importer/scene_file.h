// Mesh files that Assimp reads: OBJ, STL, glTF, GLB. A MARS that was built without Assimp (no_scene_file.cpp) refuses
// them.
#pragma once

#include <filesystem>

#include "host/content/importer/file_kind.h"
#include "host/content/importer/imported_mesh.h"

namespace mars::importer {

// As read_mesh_file().
MeshFile read_scene_file(const std::filesystem::path& path, FileKind kind, const MeshOptions& options);

}  // namespace mars::importer
