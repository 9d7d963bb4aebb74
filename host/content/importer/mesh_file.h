// Mesh files of other programs: OBJ, STL, PLY, glTF, GLB. What stands still is read: the nodes of a glTF file become
// joints, all else is one joint; what its skins place stands as its bones do in the file.
#pragma once

#include <filesystem>

#include "host/content/importer/file_kind.h"
#include "host/content/importer/imported_mesh.h"

namespace mars::importer {

// `kind` is a mesh's. Normals are the file's where it gives them for all; else the mesh has a crease: 0 for glTF, which
// says so, 30 degrees for the others. Faces that run against their normals are turned, those with fewer than three
// different vertices left out. A file that promises more faces or vertices than can be read is refused.
MeshFile read_mesh_file(const std::filesystem::path& path, FileKind kind, const MeshOptions& options);

}  // namespace mars::importer
