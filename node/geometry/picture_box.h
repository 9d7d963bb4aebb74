// Where on a picture something may be that lies within a hull of points in eye space, as a Bezier patch within its
// control points, or a meshlet within its box. Never too small.
#pragma once

#include "node/geometry/line_range.h"
#include "node/geometry/segment_place.h"
#include "node/shape/bezier.h"

namespace mars::geometry {

struct PictureSize {
  std::uint32_t width;
  std::uint32_t height;
};

// Empty where nothing of it is on the picture; all of the picture where a point is nearer than the near plane.
PictureBounds picture_box(const float (*points)[3], int count, const shape::Projection& projection,
                          const PictureSize& picture);
inline PictureBounds picture_box(const BoxCorners& corners, const shape::Projection& projection,
                                 const PictureSize& picture) {
  return picture_box(corners.point, BoxCorners::kCount, projection, picture);
}

}  // namespace mars::geometry
