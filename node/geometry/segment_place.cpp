#include "node/geometry/segment_place.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mars::geometry {
namespace {

// Of a blended place, or a mean of such, relative to the largest of what is added up to it, at most: single precision
// rounds some ten times on the way, and once for each of a stencil's terms.
constexpr double kBlendRounding = 1.0 / (1 << 15);
static_assert((wire::kMostTerms + 16.0) / (1 << 24) < kBlendRounding);

// Along the axes of eye space, round a box that several bones move.
class MovedBox {
 public:
  template <typename Corner>
  void add(const shape::EyeMatrix& bone, const Corner& low, const Corner& high) {
    for (std::size_t r = 0; r < 3; ++r) {
      double least = bone.m[r][3], most = least, reach = std::abs(least);
      for (std::size_t c = 0; c < 3; ++c) {
        const double one = double{bone.m[r][c]} * low[c], other = double{bone.m[r][c]} * high[c];
        least += std::min(one, other);
        most += std::max(one, other);
        reach += std::max(std::abs(one), std::abs(other));
      }
      low_[r] = std::min(low_[r], least);
      high_[r] = std::max(high_[r], most);
      reach_ = std::max(reach_, reach);
    }
  }

  BoxCorners corners() const {
    const double slack = reach_ * kBlendRounding;
    BoxCorners out;
    for (std::size_t k = 0; k < BoxCorners::kCount; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        out.point[k][axis] = static_cast<float>(k >> axis & 1 ? high_[axis] + slack : low_[axis] - slack);
    return out;
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::max();

  double low_[3] = {kFar, kFar, kFar}, high_[3] = {-kFar, -kFar, -kFar};
  double reach_ = 0;
};

}  // namespace

// The cofactors are scaled so that the largest is 1: squares of what they turn stay far inside a float, however small
// or large the mesh is shown.
shape::EyeMap eye_map(const shape::EyeMatrix& matrix) {
  shape::EyeMap map;
  double cofactor[3][3], largest = 0;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const float *one = matrix.m[(r + 1) % 3], *other = matrix.m[(r + 2) % 3];
      const int next = (c + 1) % 3, last = (c + 2) % 3;
      cofactor[r][c] = static_cast<double>(one[next]) * other[last] - static_cast<double>(one[last]) * other[next];
      largest = std::max(largest, std::abs(cofactor[r][c]));
    }
  for (int r = 0; r < 3; ++r) {
    std::copy_n(matrix.m[r], 4, map.place[r]);
    for (int c = 0; c < 3; ++c) map.normal[r][c] = largest > 0 ? static_cast<float>(cofactor[r][c] / largest) : 0.0f;
  }
  return map;
}

BoxCorners corners_of(const shape::EyeMatrix& matrix, const std::array<float, 3>& low,
                      const std::array<float, 3>& high) {
  BoxCorners corners;
  for (std::size_t k = 0; k < BoxCorners::kCount; ++k) {
    const auto along = [&](std::size_t axis) { return (k >> axis & 1 ? high : low)[axis]; };
    shape::to_eye(matrix, {along(0), along(1), along(2)}, corners.point[k]);
  }
  return corners;
}

shape::EyeMatrix blended(const wire::PackedFilm& film, const wire::Skin& skin, std::uint32_t point,
                         std::uint32_t points, std::span<const shape::EyeMatrix> bones) {
  shape::EyeMatrix sum{};
  const auto weights = film.weights_of(skin, points);
  std::size_t at = point;
  for (const std::uint32_t bone : film.bones_of(skin)) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c) sum.m[r][c] += weights[at] * bones[bone].m[r][c];
    at += points;
  }
  return sum;
}

std::array<float, 3> moved_point(const wire::PackedFilm& film, const wire::NetPoint& point,
                                 std::span<const shape::EyeMatrix> bones) {
  float place[3];
  shape::to_eye(blended(film, point.skin, 0, 1, bones), point.place, place);
  return std::to_array(place);
}

void SegmentPlace::find(const Scene& scene, std::size_t segment) {
  const wire::PackedFilm& film = scene.film();
  shape_ = film.segments()[segment].shape;
  bones_.clear();
  if (film.segments()[segment].bone_count > 0) return find_bones(scene, segment);
  matrix_ = scene.matrix(segment);
  if (film.shape(shape_).meshlet_count > 0) map_ = eye_map(matrix_);
}

void SegmentPlace::find_bones(const Scene& scene, std::size_t segment) {
  bones_.reserve(scene.most_bones());
  net_.start(scene.film());
  float largest = 0;
  const std::uint32_t count = scene.film().segments()[segment].bone_count;
  for (std::uint32_t bone = 0; bone < count; ++bone) {
    bones_.push_back(scene.bone_matrix(segment, bone));
    for (const auto& row : bones_.back().m)
      for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(row[c]));
  }
  scale_ = largest > 0 ? std::ldexp(1.0f, -std::clamp(std::ilogb(largest), -100, 100)) : 1;
}

bool SegmentPlace::mirrors() const { return shape::mirrors(has_skin() ? bones_.front() : matrix_); }

shape::EyePatch SegmentPlace::patch(const wire::PackedFilm& film, std::size_t number) const {
  if (!has_skin()) return shape::to_eye(matrix_, film.patches_of(shape_)[number]);
  const auto move = [&](const wire::NetPoint& point) { return moved_point(film, point, bones_); };
  const wire::NetPatch& stencils = film.net_patches_of(shape_)[number];
  shape::EyePatch moved;
  for (std::size_t point = 0; point < wire::kPatchPoints; ++point)
    std::copy_n(net_.bezier(film, stencils[point], move).begin(), 3, moved.point[point]);
  return moved;
}

BoxCorners SegmentPlace::corners(const wire::PackedFilm& film, const wire::Meshlet& meshlet) const {
  if (!has_skin()) return corners_of(matrix_, meshlet.low, meshlet.high);
  MovedBox box;
  for (const std::uint32_t bone : film.bones_of(meshlet.skin)) box.add(bones_[bone], meshlet.low, meshlet.high);
  return box.corners();
}

BoxCorners SegmentPlace::corners(const ShapeBoxes& boxes) const {
  const ShapeBoxes::Box& all = boxes.of(shape_);
  if (!has_skin()) return corners_of(matrix_, std::to_array(all.low), std::to_array(all.high));
  MovedBox moved;
  const auto of_bones = boxes.of_bones(shape_);
  for (std::size_t bone = 0; bone < of_bones.size(); ++bone)
    if (const ShapeBoxes::Box& box = of_bones[bone]; !box.is_empty()) moved.add(bones_[bone], box.low, box.high);
  return moved.corners();
}

}  // namespace mars::geometry
