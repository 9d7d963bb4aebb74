// The parts of a compiled film (film.h): plain structs, as they lie in the block. Angles are gone here:
// matrices only.
//
// Units: world lengths; colours 0..1 as they are shown (no gamma); frames count from 0.
#pragma once

#include <array>
#include <cstdint>

namespace mars::wire {

// Bumped whenever the layout or the meaning of a field changes; other versions are refused.
inline constexpr std::uint32_t kFilmVersion = 2;
inline constexpr std::uint32_t kMaxSide = 16384;         // pixels
inline constexpr std::uint32_t kMostFrames = 1'000'000;  // of a film

// A bicubic Bezier patch: point (i, j) is points[4 * j + i], i along u, j along v, in the unit cube.
// The outside is where d/du x d/dv points.
struct Patch {
  std::array<std::array<float, 3>, 16> points;
};

// Affine map, row by row: p' = m[r][0..2] . p + m[r][3].
struct Matrix {
  std::array<std::array<double, 4>, 3> m;

  bool operator==(const Matrix&) const = default;
};

// From `frame` on, until the track's next change, the element has the value numbered `value`.
struct Change {
  std::uint32_t frame;
  std::uint32_t value;
};

// changes[first, first + count): ascending frames, the first at frame 0.
struct Track {
  std::uint32_t first;
  std::uint32_t count;
};

// A part of a polygon mesh, of bounded size so that a mesh is divided over nodes as patches are: vertices
// [first_vertex, first_vertex + vertex_count) of the film's places and normals, and triangles whose corners count from
// first_vertex, counter-clockwise seen from outside. Meshlets that meet have vertices at the same places, bit for bit.
struct Meshlet {
  std::uint32_t first_vertex;
  std::uint32_t vertex_count;  // 1..kMeshletVertices
  std::uint32_t first_triangle;
  std::uint32_t triangle_count;  // 1..kMeshletTriangles
  std::array<float, 3> low;      // of the box round its vertices
  std::array<float, 3> high;
};

inline constexpr std::uint32_t kMeshletVertices = 192;
inline constexpr std::uint32_t kMeshletTriangles = 128;

// Numbers of a meshlet's vertices.
using MeshTriangle = std::array<std::uint8_t, 3>;

// Its patches, then its meshlets; most shapes have one kind.
struct Shape {
  std::uint32_t first_patch;
  std::uint32_t patch_count;
  std::uint32_t first_meshlet = 0;
  std::uint32_t meshlet_count = 0;

  std::uint64_t size() const { return std::uint64_t{patch_count} + meshlet_count; }
};

// One instance of a shape. `motion` gives indices into matrices: T-matrices from the unit cube to the world.
// `material` gives indices into materials. Patches and meshlets of the whole film are numbered segment by segment.
struct Segment {
  std::uint32_t shape;
  std::uint32_t name;  // offset into names
  Track motion;
  Track material;
};

// Phong's: ambient + diffuse * N.L coloured, specular * (R.V)^exponent white, per light.
struct Material {
  std::array<float, 3> color;
  float ambient;
  float diffuse;
  float specular;
  float exponent;
  std::uint32_t sides;  // 1: seen from outside only; 2: the normal turns to the eye

  bool operator==(const Material&) const = default;
};

// kind 0: directional, `vector` is the unit direction to the light; 1: a point light at `vector`.
struct Light {
  std::uint32_t kind;
  std::array<float, 3> vector;
  std::array<float, 3> color;  // times intensity

  bool operator==(const Light&) const = default;
};

// The eye looks along -z of its own frame, x to the right, y up. `focal` = 1 / tan(half the vertical field of
// view). Nothing nearer than near or farther than far is drawn.
struct Camera {
  Matrix world_to_eye;
  double focal;
  double near;
  double far;

  bool operator==(const Camera&) const = default;
};

// Frames [first_frame, first_frame + frame_count) over which the same segments, moving[first_moving,
// first_moving + moving_count) in ascending order, move and all others stand still, unseen by a moving
// camera or light (if one moves, every segment is listed).
struct Interval {
  std::uint32_t first_frame;
  std::uint32_t frame_count;
  std::uint32_t first_moving;
  std::uint32_t moving_count;
};

struct FilmSettings {
  std::uint32_t width;  // pixels, 1..kMaxSide
  std::uint32_t height;
  std::uint32_t frames;  // 1..kMostFrames
  std::uint32_t dice;    // 0: adaptive; N: every patch N x N quads
  std::array<float, 3> background;
  float rate;    // frames a second
  Track camera;  // indices into cameras
};

}  // namespace mars::wire
