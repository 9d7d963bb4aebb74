// The inner loops, each written once and compiled for several instruction sets (kernels.cpp); the bits are
// the same for all of them. Plain structs and pointers only: nothing inline may be shared with code that is
// compiled for a lesser CPU.
#pragma once

#include <cstdint>
#include <string_view>

#include "node/film.h"
#include "node/protocol.h"
#include "node/triangle.h"

namespace mars::node {

// Bernstein polynomials at i / rate, i = 0..rate: four cubic ones, and three quadratic ones for slopes.
struct Basis {
  const float* cubic[4];
  const float* quadratic[3];
  int rate;
};

// Points of a patch along one parameter line, with the normals there: position = cubic . point,
// along = quadratic . slope, across = cubic . cross, normal = sign * along x across, normalised.
struct Row {
  float point[4][3];
  float slope[3][3];
  float cross[4][3];
  float sign;
};

// Vertices, one array a component: eye space place and unit normal (0 where the surface has none), then
// what projection adds: screen place, 1 / w, and whether the vertex is on the screen's plane at all.
struct Vertices {
  float* place[3];
  float* normal[3];
  float* inverse_w;
  std::int32_t* x;
  std::int32_t* y;
  std::uint8_t* outside;  // 1: nearer than near, farther than far, or beyond the guard band
};

// screen x = center[0] + scale * x / w, y = center[1] - scale * y / w, w = -z, in pixels.
struct Projection {
  float scale;
  float center[2];
  float near;
  float far;
  float guard;   // pixels from the centre
  float corner;  // cosine of the angle between the view axis and the picture's corner
};

struct EyeLight {
  bool point;       // else directional
  float vector[3];  // eye space: the light's place, or the unit direction to it
  float color[3];
};

struct Shading {
  const Triangle* triangles;
  const Material* materials;
  const EyeLight* lights;
  std::uint32_t light_count;
  Projection projection;
};

// Columns [first, last); none where last <= first.
struct Extent {
  std::uint32_t first;
  std::uint32_t last;
};

struct Shaded {
  std::uint32_t runs;
  std::uint32_t pixels;
};

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

struct Kernels {
  const char* name;

  // Vertices first..last - 1 of `row` at first/rate.. into out[at..].
  void (*evaluate)(const Row& row, const Basis& basis, int first, int last, const Vertices& out, int at);

  void (*project)(const Projection& projection, const Vertices& vertices, int count);

  // Draws `count` edge boxes of one line, in order: a sample nearer than depth[x] takes over depth and id.
  // Says which columns the boxes span.
  Extent (*draw)(const EdgeBox* boxes, std::uint32_t count, float* depth, std::uint32_t* ids);

  // Shades the samples of line `line` within `extent` whose id is not kNoTriangle, their runs to `runs` and
  // their pixels to `pixels`; says how many of each.
  Shaded (*shade)(const Shading& shading, const std::uint32_t* ids, std::uint32_t line, Extent extent, Run* runs,
                  std::uint32_t* pixels);
};

// The widest kernels that this CPU runs and that are not wider than `limit` ("sse2", "avx2", "avx512";
// "" for no limit). Throws Failure for another name.
const Kernels& best_kernels(std::string_view limit);

}  // namespace mars::node
