// The inner loops, each written once and compiled for several instruction sets (kernels/); the bits are
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

// What weighs a patch's 16 control points at each of 16 places of it: for the place itself and its derivatives.
struct SurveyWeights {
  enum Kind { kPlace, kU, kV, kUU, kUV, kVV, kKinds };
  alignas(64) float weight[kKinds][16][16];  // [control point][place]
};

// A diced curve strays from the true one by no more than this many pixels; the inside of a surface by about twice
// as much, where it is seen edge-on, as outlines are.
inline constexpr float kTolerance = 0.1875f;
// Nor does its normal turn by more than about this (radians) in a step, unless the step is shorter than kLeastStep
// pixels.
inline constexpr float kTurn = 0.2f;
inline constexpr float kLeastStep = 4.0f;

// How finely a patch's inside is to be diced, in steps, before rounding.
struct Fineness {
  float u;
  float v;
};

// Kernels work on whole vectors: every array of vertices, of triangles' corners and of pixels has room for this many
// items more than are asked for, which may be written (with anything) or read; corners there must be numbers of
// vertices. So has a line's depth and ids; there what lies behind the line is read, and written back as it was.
inline constexpr int kVectorSlack = 16;

// Vertices, one array a component: eye space place and unit normal (0 where the surface has none), then
// what projection adds: values, screen place, and whether the vertex is on the screen's plane at all.
struct Vertices {
  float* place[3];
  float* normal[3];
  float (*values)[kValues];  // 1 / w, normal / w
  std::int32_t* x;
  std::int32_t* y;
  std::uint8_t* outside;  // 1: nearer than near, farther than far, or beyond the guard band
};

// Vertices of one triangle, counter-clockwise seen from outside in an eye space that is not mirrored.
struct Corner3 {
  std::uint32_t a, b, c;
};

inline constexpr std::uint32_t kExamined = 16;  // triangles at most in a batch

// Triangles [first, last), which are examined together. `consecutive`: each corner's numbers go up by one.
struct Batch {
  std::uint32_t first;
  std::uint32_t last;
  bool consecutive;
};

// The triangles of a diced patch, one array a corner, and the batches that tile them.
struct Triangles {
  const std::uint32_t* a;
  const std::uint32_t* b;
  const std::uint32_t* c;
  std::uint32_t count;
  const Batch* batches;
  std::uint32_t batch_count;

  Corner3 operator[](std::uint32_t k) const { return {a[k], b[k], c[k]}; }
};

// Triangles no higher than this many 1/256 pixel may have been turned over by snapping.
inline constexpr int kThin = 4;

// What is asked of triangles whose vertices are all on the screen's plane.
struct Examination {
  std::int32_t width;
  std::int32_t height;
  bool one_sided;  // those whose outside is turned away are dropped
  bool mirrored;   // their outside is the other side
};

inline constexpr std::int32_t kMostExtent = 96;  // pixels; larger triangles are left undecided

// A batch's triangles in one of three states: decided, with the columns they cover row by row, at least one;
// undecided, where they are larger than kMostExtent or may have been turned over; or dropped: turned away or
// between samples.
struct Examined {
  std::uint32_t decided;    // one bit a triangle
  std::uint32_t undecided;
  std::uint32_t faces;      // the side from which a, b, c run counter-clockwise is turned to the eye
  alignas(64) std::int32_t first_row[kExamined];
  alignas(64) std::int32_t last_row[kExamined];
  alignas(64) std::uint32_t columns[kMostExtent][kExamined];  // of row first_row + r at [r]: first | last << 16, or 0
  // b - a and c - a, 1/256 pixel, and 1 / twice the area.
  alignas(64) float x1[kExamined];
  alignas(64) float y1[kExamined];
  alignas(64) float x2[kExamined];
  alignas(64) float y2[kExamined];
  alignas(64) float inverse[kExamined];
};

// From a mesh's own space to eye space. Normals go by the cofactors of the places' linear part, which is where the cross
// product of two moved vectors points: the inverse's transpose but for its length, and turned where that mirrors.
struct EyeMap {
  float place[3][4];
  float normal[3][3];
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

// What a patch's or a meshlet's triangles have in common.
struct PatchIdentity {
  std::uint32_t patch;
  std::uint32_t look;
  bool mirrored;   // its matrix turns shapes inside out
  bool one_sided;  // triangles seen from inside are dropped
  bool moving;
};

// b - a and c - a of a triangle, 1/256 pixel, 1 / twice its area, and whether the side from which a, b, c run
// counter-clockwise is turned to the eye.
struct ScreenShape {
  float x1, y1, x2, y2;
  float inverse;
  bool faces;
};

// Where set-ups go: triangles forward from `next`, their crossings backward from `crossing`.
struct SetUpSpace {
  Triangle* first;     // the frame's triangles count from here
  Triangle* next;
  Crossing* crossing;  // the one stored last
  std::uint32_t* line_counts;        // edge boxes a line, of all that is added
  const std::uint8_t* wanted_lines;  // 1: edge boxes there are kept and counted
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

  // Of a patch's inside: see inside_rates (bezier.h).
  Fineness (*survey)(const SurveyWeights& weights, const float (*points)[3], const Projection& projection);

  // Vertices first..last - 1 of `row` at first/rate.. into out[at..]. Whether all have a normal.
  bool (*evaluate)(const Row& row, const Basis& basis, int first, int last, const Vertices& out, int at);

  // Vertices 0..count - 1 of a mesh, their normals of unit length or 0. Of both lists kVectorSlack more are read.
  void (*move)(const EyeMap& map, const float (*places)[3], const float (*normals)[3], int count, const Vertices& out);

  // Whether any of the vertices is outside.
  bool (*project)(const Projection& projection, const Vertices& vertices, int count);

  void (*examine)(const Examination& task, const Vertices& vertices, const Triangles& triangles, const Batch& batch,
                  Examined& out);

  // The triangle's identity and planes.
  void (*set)(const Vertices& vertices, const Corner3& corners, const ScreenShape& shape, const PatchIdentity& identity,
              Triangle& out);

  // Stores set-ups of those of the batch's decided triangles that `lanes` has bits for, and that have a box on a
  // wanted line. There must be room for all.
  void (*keep)(const Vertices& vertices, const Triangles& triangles, const Batch& batch, const Examined& examined,
               std::uint32_t lanes, const PatchIdentity& identity, SetUpSpace& out);

  // Draws `count` edge boxes of line `line`, in any order: a sample nearer than depth[x] takes over depth and id; of
  // two triangles as near the lower patch's is seen, within a patch the first. Says which columns the boxes span.
  Extent (*draw)(const Triangle* triangles, const EdgeBox* boxes, std::uint32_t count, std::uint32_t line,
                 float* depth, std::uint32_t* ids);

  // Shades the samples of line `line` within `extent` whose id is not kNoTriangle, their runs to `runs` and
  // their pixels to `pixels`; says how many of each.
  Shaded (*shade)(const Shading& shading, const std::uint32_t* ids, std::uint32_t line, Extent extent, Run* runs,
                  std::uint32_t* pixels);
};

// The widest kernels that this CPU runs and that are not wider than `limit` ("sse2", "sse4", "avx2",
// "avx512";
// "" for no limit). Throws Failure for another name.
const Kernels& best_kernels(std::string_view limit);

}  // namespace mars::node
