// Where on a picture something may be that lies within a hull of points in eye space, as a Bezier patch within its
// control points, or a meshlet within its box. Never too small.
#pragma once

#include "node/geometry/line_range.h"
#include "node/shape/bezier.h"
#include "node/wire/film.h"

namespace mars::geometry {

struct PictureSize {
  std::uint32_t width;
  std::uint32_t height;
};

// Empty where nothing of it is on the picture; all of the picture where a point is nearer than the near plane.
PictureBounds picture_box(const float (*points)[3], int count, const shape::Projection& projection,
                          const PictureSize& picture);
// The same of a box of the space that `matrix` takes to eye space: its corners.
PictureBounds picture_box(const shape::EyeMatrix& matrix, const std::array<float, 3>& low,
                          const std::array<float, 3>& high, const shape::Projection& projection,
                          const PictureSize& picture);

}  // namespace mars::geometry
