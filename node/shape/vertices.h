// Vertices and triangles in eye space and on the screen, and what kernels make them from: patches and meshes. Plain
// structs only: kernels of several instruction sets share them (kernels.h).
//
// Screen places are snapped to 1/256 pixel; sample (column, row) lies at (256 column + 128, 256 row + 128).
#pragma once

#include <cstdint>

#include "node/simd/vector_slack.h"

namespace mars::shape {

inline constexpr std::int32_t kSubpixels = 256;
inline constexpr std::int32_t kSampleOffset = kSubpixels / 2;

// The values that a sample takes from a triangle: 1 / w, w the distance along the view axis (greater is nearer), and
// the eye space normal / w, turned to the eye. In parallel projection: -w, and the normal.
enum Value { kDepth, kNormalX, kNormalY, kNormalZ, kValues };

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

// The weights of a patch's 16 control points at each of 16 places of it: for the place itself and its derivatives.
struct CurvatureWeights {
  enum Kind { kPlace, kU, kV, kUU, kUV, kVV, kKinds };
  alignas(64) float weight[kKinds][16][16];  // [control point][place]
};

// How far triangles may be from the surface that they stand for.
struct Tolerances {
  // Pixels by which a diced curve strays from the true one at most; the inside of a surface strays by about twice as
  // many, where it is seen edge-on, as outlines are.
  float outline;
  // Radians by which a normal turns in a step at most, about, unless the step is shorter than `least_step` pixels.
  float turn;
  float least_step;
};

// How finely a patch's inside is to be diced, in steps, before rounding.
struct Fineness {
  float u;
  float v;
};

// From a mesh's own space to eye space. Normals go by the cofactors of the places' linear part, which is where the
// cross product of two moved vectors points: the inverse's transpose but for its length, and turned where that mirrors.
struct EyeMap {
  float place[3][4];
  float normal[3][3];
};

// A bone of a skin whose blend is by dual quaternions (dual_quaternion.h): how it turns (w, x, y, z), half its place
// times that, and what it does before.
template <typename Number>
struct DualBone {
  Number real[4];
  Number dual[4];
  Number stretch[3][3];
};

// The same of a mesh with a skin: each vertex goes by a blend of its bones, in the order of the bones, and its normal
// by the cofactors of that. The blend is the sum of their matrices, each times its weight, or that of dual quaternions.
struct EyeSkin {
  const float (*bones)[3][4];    // to eye space
  const DualBone<float>* duals;  // the same bones; nullptr: the blend is linear
  const float* weights;          // bone by bone, of each vertex
  int bone_count;
  float scale;  // what bones are multiplied by for cofactors, so that squares of cofactors stay far inside a float
};

// In pixels of the whole picture x = center[0] + scale * squeeze * x / w, y = center[1] - scale * y / w, w = -z; in
// parallel projection nothing is divided by w. The pixels that are drawn are counted from `origin`, which is subtracted
// from snapped places, in whole numbers: what a pixel shows does not depend on which part of the picture is drawn.
struct Projection {
  float scale;
  float center[2];
  float near;
  float far;
  float guard;        // pixels from the centre
  float corner;       // cosine of the angle between the view axis and the picture's farthest corner; not of parallel
  float radius = 0;   // of parallel projection: from the view axis to that corner, a length of eye space
  float nothing = 0;  // the depth of samples that show nothing, below all others
  bool parallel = false;
  float squeeze = 1;                // height of a pixel by its width
  std::int32_t origin[2] = {0, 0};  // of the part that is drawn, in pixels of the whole picture
};
inline constexpr float kFarthestDepth = -3.40282347e+38f;  // Projection::nothing of parallel projection

// What vertices have instead of a normal where triangles carry colours, as seen from one side: red, green and blue, and
// 1 / w, colour / w.
struct VertexColors {
  float* color[3];
  float (*values)[kValues];
};

// Vertices, one array a component: eye space place and unit normal (0 where the surface has none), then
// what projection adds: values, screen place, and whether the vertex is on the screen's plane at all. Arrays are longer
// by kVectorSlack.
struct Vertices {
  float* place[3];
  float* normal[3];
  float (*values)[kValues];  // 1 / w, normal / w
  std::int32_t* x;
  std::int32_t* y;
  std::uint8_t* outside;                 // 1: nearer than near, farther than far, or beyond the guard band
  const VertexColors* colors = nullptr;  // if any: two, seen from where corners run counter-clockwise, and from behind
};

// Vertices of one triangle, counter-clockwise seen from outside in an eye space that is not mirrored.
struct Corner3 {
  std::uint32_t a, b, c;
};

inline constexpr std::uint32_t kBatchTriangles = 16;  // at most

// Triangles [first, last), which are classified together. `consecutive`: each corner's numbers go up by one.
struct Batch {
  std::uint32_t first;
  std::uint32_t last;
  bool consecutive;
};

// The triangles of a diced patch or a meshlet, one array a corner, and the batches that tile them.
struct Triangles {
  const std::uint32_t* a;
  const std::uint32_t* b;
  const std::uint32_t* c;
  std::uint32_t count;
  const Batch* batches;
  std::uint32_t batch_count;

  Corner3 operator[](std::uint32_t k) const { return {a[k], b[k], c[k]}; }
};

}  // namespace mars::shape
