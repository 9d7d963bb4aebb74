// A measuring scene as triangles, for the peers: what MARS's own dicer makes of a film's patches, in the eye space
// of the film's one camera, with one directional light. A film with more than this holds is refused.
//
// Eye space: the eye at 0 looking along -z, x to the right, y up. Screen x = center[0] - scale * x / z,
// y = center[1] + scale * y / z, in pixels from the top left; a sample is a pixel's centre.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mars::bench {

struct MeshHead {
  std::array<char, 8> magic;  // kMeshMagic
  std::uint32_t width, height;
  float scale;
  std::array<float, 2> center;
  float near;
  std::array<float, 3> background;
  std::array<float, 3> to_light;  // unit
  std::array<float, 3> light;     // its colour
  float ambient, diffuse, specular;
  std::uint32_t squarings;  // specular exponent: 2 to this
  std::uint32_t looks, patches, vertices, triangles, frames;
};

inline constexpr std::array<char, 8> kMeshMagic{'M', 'A', 'R', 'S', 'M', 'S', 'H', '1'};

// Phong's illumination: (ambient + diffuse * N.L * light) times this colour, and specular * (R.V)^exponent * light,
// where R.V counts only where N.L > 0.
using Look = std::array<float, 3>;

struct Vertex {
  std::array<float, 3> place;
  std::array<float, 3> normal;  // unit, to the outside
};

// Corners, counter-clockwise seen from outside: indices into all vertices.
using Corners = std::array<std::uint32_t, 3>;

// One diced patch. Patches of one segment follow each other, those that move come last.
struct MeshPatch {
  std::uint32_t segment;
  std::uint32_t look;
  std::uint32_t moves;  // 1 if it does
  std::uint32_t first_vertex, vertices;
  std::uint32_t first_triangle, triangles;
};

// Takes what moves from its place at frame 0 to that at another: turns and shifts only, row by row.
using Motion = std::array<std::array<float, 4>, 3>;

inline constexpr Motion kStill{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

struct Mesh {
  MeshHead head;
  std::vector<Look> looks;
  std::vector<MeshPatch> patches;
  std::vector<Vertex> vertices;
  std::vector<Corners> triangles;
  std::vector<Motion> motion;  // one a frame

  // Where what moves begins among the triangles; their number where nothing moves.
  std::uint32_t first_moving_triangle() const;
};

// The head, then the vectors in order. Throw std::runtime_error that names the file.
void write_mesh(const Mesh& mesh, const std::string& path);
Mesh read_mesh(const std::string& path);

}  // namespace mars::bench
