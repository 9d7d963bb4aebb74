// Bicubic Bezier patches in eye space: moving them there, and how finely each must be diced. Pure shape: no
// message, no film, no picture. Rates are numbers of steps.
#pragma once

#include <array>
#include <cstdint>

#include "node/shape/kernels.h"
#include "node/wire/film_parts.h"

namespace mars::shape {

inline constexpr int kMaxRate = 256;

struct EyeMatrix {
  float m[3][4];
};

// Point (i, j) is point[4 * j + i], i along u.
struct EyePatch {
  float point[16][3];
};

// Four control points of a curve.
struct Curve {
  float point[4][3];
};

// What pictures of 1, 2, 4, 8 or 16 samples a pixel need. With several, adaptive dicing adds at most 0.05 to the RMS
// error (of 255) that 256 x 256 quads a patch leave: `mars bench quality --dicing`.
Tolerances tolerances_of(std::uint32_t samples);

// How patches are diced.
struct Dicing {
  int fixed_rate;  // steps of every side and of the inside; 0: as few as the tolerances allow
  Tolerances tolerances;
  int most_inside =
      kMaxRate;  // steps of the inside, at most; sides, which other patches share, have as many as they need
};

enum class Side { bottom, right, top, left };  // v = 0, u = 1, v = 1, u = 0

struct Rates {
  int u;
  int v;
  int side[4];  // indexed by Side

  bool operator==(const Rates&) const = default;
};

// world_to_eye * to_world, rounded once.
EyeMatrix eye_matrix(const wire::Matrix& world_to_eye, const wire::Matrix& to_world);
// Whether the map turns shapes inside out.
bool mirrors(const EyeMatrix& matrix);

EyePatch to_eye(const EyeMatrix& matrix, const wire::Patch& patch);
void to_eye(const EyeMatrix& matrix, const std::array<float, 3>& place, float (&out)[3]);

// Basis of `rate` steps, 1..kMaxRate; tables live as long as the program.
const Basis& basis(int rate);

// An edge in its one canonical direction, which depends on its four points alone; `reversed`: it runs against u or v.
struct Edge {
  Curve curve;
  bool reversed;
};
Edge edge(const EyePatch& patch, Side side);

// Steps so that chords stay within `tolerance` pixels of the curve on the screen (Filip, Magedson & Markot, "Surface
// algorithms using bounds on derivatives", 1986), from the four points alone; direction does not matter.
int edge_rate(const Curve& curve, const Projection& projection, float tolerance);

// Rates of the sides and of the inside. Adaptive ones go by what the inside bends along its normal, as it
// is seen, and how its normal turns, at sixteen places. A side that is one point is as fine as the inside, for
// its normals differ, and no other patch's edge can come apart from it; rows towards it are as many, for between
// two of its normals shading breaks.
Rates rates(const ShapeKernels& kernels, const EyePatch& patch, const Projection& projection, const Dicing& dicing);

// Whether the patch surely leaves no mark on the width x height pixels from the projection's origin on: its hull lies
// outside.
bool unseen(const EyePatch& patch, const Projection& projection, float width, float height);
// The same of anything within the hull of `count` points.
bool unseen(const float (*points)[3], int count, const Projection& projection, float width, float height);

}  // namespace mars::shape
