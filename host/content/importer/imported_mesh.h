// What a mesh file of another program becomes: meshes in the unit cube, and a list of what else the file holds.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/content/modeler/mesh.h"
#include "host/content/modeler/model.h"

namespace mars::importer {

// How a person wants the file read.
struct MeshOptions {
  glm::dmat3 upright{1};  // turns the file's axes into ours
  double scale = 1;
  std::optional<double> crease;  // degrees; given: normals follow from the faces, whatever the file says
  std::string set_material;      // "mars model set rock.json rock --material color": remedies begin so
};

// The faces of one colour.
struct MeshPart {
  std::optional<std::array<double, 3>> color;  // none: the file gives none
  modeler::Mesh mesh;
};

// All parts are scaled together from `bounds` into the unit cube, so that vertices they share stay the same.
struct MeshFile {
  std::vector<MeshPart> parts;  // at least one, in the file's order
  modeler::Box bounds;
  glm::dvec3 extent;                              // of the faces; 0 where they are flat
  std::size_t vertices = 0;                       // in the file, before those that agree in place and normal are joined
  std::vector<std::string> not_read;              // "19 bones", ...
  std::vector<std::filesystem::path> companions;  // files that were read besides: materials, buffers
};

}  // namespace mars::importer
