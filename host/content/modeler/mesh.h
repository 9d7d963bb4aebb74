// Polygon meshes, as model files give them: vertices in the unit cube and flat faces between them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host/content/modeler/skin_weights.h"

namespace mars::modeler {

inline constexpr std::size_t kMostCorners = 4096;  // of a face
inline constexpr double kDefaultCrease = 30;

struct Mesh {
  using Place = std::array<float, 3>;
  using Triangle = std::array<std::uint32_t, 3>;

  std::vector<Place> vertices;
  std::vector<Place> normals;          // one a vertex, or none: then they follow from the faces
  std::vector<std::uint32_t> corners;  // numbers of vertices, face after face, counter-clockwise seen from outside
  std::vector<std::uint32_t> ends;     // of each face in corners
  double crease = kDefaultCrease;      // degrees; where faces meet at more, the edge stays sharp
  std::vector<VertexBones> bones;      // of a skin one a vertex, else none

  bool operator==(const Mesh&) const = default;

  std::size_t first_corner(std::size_t face) const { return face == 0 ? 0 : ends[face - 1]; }
  std::span<const std::uint32_t> face(std::size_t number) const {
    return std::span(corners).subspan(first_corner(number), ends[number] - first_corner(number));
  }
};

// A vector along the face's normal, by the order of its corners, as long as twice the face's area (Newell's method).
std::array<double, 3> area_vector(const Mesh& mesh, std::span<const std::uint32_t> face);

// Whether the normals given at the face's corners point to its inside, by the order of its corners.
bool turned_inside(const Mesh& mesh, std::span<const std::uint32_t> face);

// The face in triangles between its own corners, which are numbered from 0: two fewer than it has corners. It need not
// be convex. None where its outline crosses itself.
std::optional<std::vector<Mesh::Triangle>> split(const Mesh& mesh, std::span<const std::uint32_t> face);

}  // namespace mars::modeler
