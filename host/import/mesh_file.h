// Mesh files of other programs - OBJ, STL, PLY, glTF, GLB - as meshes in the unit cube. What stands still is read;
// bones, animations, textures, lines and points are not.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/modeler/mesh.h"
#include "host/modeler/model.h"

namespace mars::host {

// The faces of one colour.
struct MeshPart {
  std::optional<std::array<double, 3>> color;  // none: the file gives none
  Mesh mesh;
};

// All parts are scaled together from `bounds` into the unit cube, so that vertices they share stay the same.
struct MeshFile {
  std::vector<MeshPart> parts;  // at least one, in the file's order
  Box bounds;
};

// Whether a file of this name is one that read_mesh_file() knows.
bool is_mesh_file(const std::filesystem::path& path);

// Normals are the file's where it gives them for all; else the mesh has a crease: 0 for glTF, which says so, 30 degrees
// for the others. Faces that run against their normals are turned, those with fewer than three different vertices left
// out. glTF's y becomes z, as it is up there.
MeshFile read_mesh_file(const std::filesystem::path& path);

}  // namespace mars::host
