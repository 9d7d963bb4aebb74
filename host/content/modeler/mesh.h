// Polygon meshes, as model files give them: vertices in the unit cube and flat faces between them.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mars::modeler {

inline constexpr std::size_t kMostCorners = 4096;  // of a face
inline constexpr double kDefaultCrease = 30;

inline constexpr std::size_t kMostBones = 65536;      // of a skin
inline constexpr std::size_t kMostBonesOfVertex = 4;  // as nodes take them

// Which bones a vertex of a skin follows, and how much each: numbers in the skin's list, ascending. Weights above 0,
// whose sum is 1, come first.
struct VertexBones {
  std::array<std::uint32_t, kMostBonesOfVertex> bone{};
  std::array<float, kMostBonesOfVertex> weight{};

  auto operator<=>(const VertexBones&) const = default;
};

struct BoneWeight {
  std::uint32_t bone;
  double weight;
};

// Of bones in any order, some of them perhaps several times: the heaviest, with weights that add up to 1. None where no
// weight is above 0.
std::optional<VertexBones> bones_of_vertex(std::vector<BoneWeight> bones);

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
