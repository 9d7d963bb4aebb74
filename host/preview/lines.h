// Lines between points, some of them marked: a wire picture of one thing in coordinates of its own. And what hides
// lines.
#pragma once

#include <cstdint>
#include <vector>

#include "host/content/modeler/control_net.h"
#include "host/content/modeler/mesh.h"

namespace mars::preview {

struct Lines {
  std::vector<float> points;        // x, y, z of each
  std::vector<std::uint32_t> ends;  // two points a line
  std::uint32_t dots = 0;           // the first `dots` points are marked: joints, control vertices
  // Of a skin: the first points are means of `net`, by number; what the others follow.
  modeler::ControlNet net{};
  std::vector<std::uint32_t> means{};
  std::vector<modeler::VertexBones> bones{};
};

// Triangles between points, which hide lines behind them.
struct Facets {
  std::vector<float> points;
  std::vector<std::uint32_t> corners;  // three points a triangle
};

}  // namespace mars::preview
