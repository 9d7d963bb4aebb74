// The plain twin of set-up: a diced patch's triangles one by one, from nothing but the places and normals of its
// vertices, with planes by the formulas and coverage sample by sample. It shares clipping with the nodes (which
// clip_test checks) and nothing else.
#pragma once

#include <cstdint>
#include <vector>

#include "node/geometry/clip.h"
#include "node/raster/outline.h"
#include "node/raster/setup.h"
#include "node/shape/surface.h"

namespace mars::raster {

struct PlainTriangle {
  Corners corners;
  geometry::Triangle record;      // what a node makes of it
  std::uint32_t index;            // in the patch's dicing; pieces of a clipped triangle share it
  bool faces;                     // the side from which its corners run counter-clockwise in space is turned to the eye
  geometry::ClipVertex eye[3];    // its corners in eye space
  geometry::ClipVertex whole[3];  // those of the triangle of which clipping made it; the same where none did
};

// All that are not turned away or flat, in order, whether they cover a sample or not. `casting` as of SetUp.
std::vector<PlainTriangle> plain_set_up(const shape::Surface& surface, const shape::Projection& projection,
                                        const PatchIdentity& identity, bool casting = false);

// Twice the area in 1/65536 square pixel; y grows downwards, so negative where counter-clockwise to the eye.
std::int64_t area(const Corners& corners);

// Whether the place (1/256 pixel) is inside, or on a left or top side: by the three sides' functions in 64-bit
// integers.
bool covers_place(const Corners& corners, std::int64_t x, std::int64_t y);
// Whether the sample of a column on a row of the pattern is inside in the same sense.
bool covers(const Corners& corners, std::int32_t column, std::int32_t row, const shape::SamplePattern& pattern);

// The boxes of the samples of a picture that the triangle covers, from the top.
std::vector<UnsortedEdgeBox> plain_edge_boxes(const Corners& corners, std::int32_t width, std::int32_t height,
                                              const shape::SamplePattern& pattern);

}  // namespace mars::raster
