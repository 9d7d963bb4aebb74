// Triangles on their way to set-ups: classified sixteen at a time, and where the set-ups go. Plain structs only:
// kernels of several instruction sets share them (kernels.h).
#pragma once

#include <cstdint>

#include "node/geometry/triangle.h"
#include "node/raster/edge_box.h"
#include "node/raster/line_load.h"
#include "node/shape/sample_pattern.h"
#include "node/shape/vertices.h"

namespace mars::raster {

// Triangles no higher than this many 1/256 pixel may have been turned over by snapping.
inline constexpr int kThin = 4;

// For triangles whose vertices are all on the screen's plane.
struct ClassifyTask {
  std::int32_t width;  // pixels
  std::int32_t height;
  shape::SamplePattern pattern;
  bool one_sided;  // those whose outside is turned away are dropped
  bool mirrored;   // their outside is the other side
};

inline constexpr std::int32_t kMostExtent = 96;  // pixels; larger triangles are left undecided

// A batch's triangles in one of three states: decided, with the columns they cover row by row, at least one;
// undecided, where they are larger than kMostExtent or may have been turned over; or dropped: turned away or
// between samples.
struct Classified {
  std::uint32_t decided;  // one bit a triangle
  std::uint32_t undecided;
  std::uint32_t faces;  // the side from which a, b, c run counter-clockwise is turned to the eye
  // Rows (SamplePattern) from the first one of line first_line on that may have samples: [first_row, last_row).
  alignas(64) std::int32_t first_line[shape::kBatchTriangles];
  alignas(64) std::int32_t first_row[shape::kBatchTriangles];
  alignas(64) std::int32_t last_row[shape::kBatchTriangles];
  // Of each such row: first | last << 16, or 0. A triangle that begins within a line reaches one more.
  alignas(64) std::uint32_t columns[(kMostExtent + 1) * shape::kMostSamples][shape::kBatchTriangles];
  // b - a and c - a, 1/256 pixel, and 1 / twice the area.
  alignas(64) float x1[shape::kBatchTriangles];
  alignas(64) float y1[shape::kBatchTriangles];
  alignas(64) float x2[shape::kBatchTriangles];
  alignas(64) float y2[shape::kBatchTriangles];
  alignas(64) float inverse[shape::kBatchTriangles];
};

// Common to all triangles of a patch or a meshlet.
struct PatchIdentity {
  std::uint32_t patch;
  std::uint32_t material;
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

// Where set-ups go: triangles forward from `next`, their edge boxes backward from `last_box`.
struct SetUpSpace {
  geometry::Triangle* first;  // triangles count from here
  geometry::Triangle* next;
  UnsortedEdgeBox* last_box;         // the one stored last
  std::uint32_t log2_samples;        // a pixel
  LineLoad* line_loads;              // of all that is added
  const std::uint8_t* wanted_lines;  // 1: edge boxes there are stored and counted
};

}  // namespace mars::raster
