// A polygon mesh as nodes read it: triangles with the normals of their corners, cut into meshlets (node/wire/film.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/content/modeler/mesh.h"
#include "node/wire/film.h"

namespace mars::modeler {

struct Meshlets {
  std::vector<std::array<float, 3>> places;
  std::vector<std::array<float, 3>> normals;
  std::vector<wire::MeshTriangle> triangles;
  std::vector<wire::Meshlet> meshlets;
  SkinLists skins;
};

// Triangles that lie near each other are in one meshlet; a vertex is in every meshlet that has triangles there.
Meshlets cut_meshlets(const Mesh& mesh);

}  // namespace mars::modeler
