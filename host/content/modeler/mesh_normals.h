// Normals of a mesh's corners. Faces that meet in an edge at no more than the crease angle are smooth there: round a
// vertex, all corners between sharp edges share one normal, the sum of their faces' normals, each weighted by the angle
// of its corner (Thuermer & Wuethrich, "Computing vertex normals from polygonal facets", 1998). Vertices at the same
// place count as one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/content/modeler/mesh.h"

namespace mars::modeler {

// Vertices that differ in place, normal or bones, and the one of each of the mesh's corners.
struct ShadedVertices {
  std::vector<std::array<float, 3>> places;
  std::vector<std::array<float, 3>> normals;
  std::vector<std::uint32_t> of_corners;
  std::vector<VertexBones> bones;  // of a skin one a vertex, else none
};

ShadedVertices shaded_vertices(const Mesh& mesh);

}  // namespace mars::modeler
