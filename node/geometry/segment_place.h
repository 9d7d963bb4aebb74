// Where a segment is in eye space at its scene's frame: its one matrix moves it, or, where it has a skin, its bones'.
// What bounds it bounds either: a skin's vertices and the points of nets go by sums of matrices whose weights add up to
// 1, so what lies in a box stays between where its bones move the box; and Bezier points stay between those of nets.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "node/geometry/net_points.h"
#include "node/geometry/scene.h"
#include "node/shape/bezier.h"
#include "node/wire/film.h"

namespace mars::geometry {

// Points of eye space between which something lies.
struct BoxCorners {
  static constexpr int kCount = 8;

  float point[kCount][3];
};

// How `matrix` moves places and turns normals.
shape::EyeMap eye_map(const shape::EyeMatrix& matrix);
// Where it moves a box's corners.
BoxCorners corners_of(const shape::EyeMatrix& matrix, const std::array<float, 3>& low,
                      const std::array<float, 3>& high);

// The matrix of point number `point` of `points` that have a skin: the sum of its bones', each times its weight, in the
// skin's order. It begins with 0, so a bone without weight changes no bit of it, and points that skins with different
// bones share stay the same.
shape::EyeMatrix blended(const wire::PackedFilm& film, const wire::Skin& skin, std::uint32_t point,
                         std::uint32_t points, std::span<const shape::EyeMatrix> bones);

// Where bones move a net's point.
std::array<float, 3> moved_point(const wire::PackedFilm& film, const wire::NetPoint& point,
                                 std::span<const shape::EyeMatrix> bones);

class SegmentPlace {
 public:
  // Of the segment, until the next call.
  void find(const Scene& scene, std::size_t segment);

  bool has_skin() const { return !bones_.empty(); }
  bool mirrors() const;  // whether it turns shapes inside out; of a skin, whether its first bone does
  // Of a rigid segment.
  const shape::EyeMatrix& matrix() const { return matrix_; }
  const shape::EyeMap& map() const { return map_; }
  // Of a skin, by number; and EyeSkin::scale, a power of two, with which segments that share vertices give these the
  // same normals.
  std::span<const shape::EyeMatrix> bones() const { return bones_; }
  float scale() const { return scale_; }

  // One of its shape's patches, by its number in the shape.
  shape::EyePatch patch(const wire::PackedFilm& film, std::size_t number) const;
  // Round one of its shape's meshlets, and round all of its shape.
  BoxCorners corners(const wire::PackedFilm& film, const wire::Meshlet& meshlet) const;
  BoxCorners corners(const ShapeBoxes& boxes) const;

 private:
  void find_bones(const Scene& scene, std::size_t segment);

  std::uint32_t shape_ = 0;
  shape::EyeMatrix matrix_{};
  shape::EyeMap map_{};
  std::vector<shape::EyeMatrix> bones_;
  mutable NetPoints<float> net_;  // patches ask for the same points
  float scale_ = 1;
};

}  // namespace mars::geometry
