#include "node/geometry/segment_place.h"

#include <algorithm>
#include <cmath>

namespace mars::geometry {
namespace {

wire::Matrix in_doubles(const shape::EyeMatrix& matrix) {
  wire::Matrix out;
  for (std::size_t r = 0; r < 3; ++r) std::copy_n(matrix.m[r], 4, out.m[r].begin());
  return out;
}

BoxCorners corners_of(const SkinBounds::Box& box) {
  BoxCorners out;
  for (std::size_t k = 0; k < BoxCorners::kCount; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      out.point[k][axis] = static_cast<float>((k >> axis & 1 ? box.high : box.low)[axis]);
  return out;
}

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

void EyeBones::begin(wire::Blend blend, std::size_t count) {
  matrices.resize(count);
  duals.resize(blend == wire::Blend::dual_quaternions ? count : 0);
}

void EyeBones::put(std::size_t bone, const shape::EyeMatrix& matrix) {
  matrices[bone] = matrix;
  if (!duals.empty()) duals[bone] = shape::rounded(shape::dual_bone(shape::parts_of(in_doubles(matrix))));
}

shape::EyeMatrix blended(const wire::PackedFilm& film, const wire::Skin& skin, std::uint32_t point,
                         std::uint32_t points, const EyeBones& bones) {
  shape::EyeMatrix sum{};
  shape::DualBlend<float> dual;
  const bool is_dual = !bones.duals.empty();
  const auto weights = film.weights_of(skin, points);
  std::size_t at = point;
  for (const std::uint32_t bone : film.bones_of(skin)) {
    if (is_dual) dual.add(bones.duals[bone], weights[at]);
    for (int r = 0; r < 3 && !is_dual; ++r)
      for (int c = 0; c < 4; ++c) sum.m[r][c] += weights[at] * bones.matrices[bone].m[r][c];
    at += points;
  }
  if (is_dual) dual.put(sum.m);
  return sum;
}

std::array<float, 3> moved_point(const wire::PackedFilm& film, const wire::NetPoint& point, const EyeBones& bones) {
  float place[3];
  shape::to_eye(blended(film, point.skin, 0, 1, bones), point.place, place);
  return std::to_array(place);
}

void SegmentPlace::find(const Scene& scene, std::size_t segment) {
  const wire::PackedFilm& film = scene.film();
  shape_ = film.segments()[segment].shape;
  bones_.begin(wire::Blend::linear, 0);
  if (film.segments()[segment].bone_count > 0) return find_bones(scene, segment);
  matrix_ = scene.matrix(segment);
  if (film.shape(shape_).meshlet_count > 0) map_ = eye_map(matrix_);
}

void SegmentPlace::find_bones(const Scene& scene, std::size_t segment) {
  const wire::Segment& of = scene.film().segments()[segment];
  bones_.matrices.reserve(scene.most_bones());
  if (of.blend == wire::Blend::dual_quaternions) bones_.duals.reserve(scene.most_bones());
  bones_.begin(of.blend, of.bone_count);
  bounds_.begin(of.blend, scene.most_bones());
  net_.start(scene.film());
  bone_pairs_ = scene.bone_pairs();
  for (std::uint32_t bone = 0; bone < of.bone_count; ++bone) {
    bones_.put(bone, scene.bone_matrix(segment, bone));
    bounds_.add(in_doubles(bones_.matrices[bone]));
  }
}

float SegmentPlace::scale(const wire::PackedFilm& film, const wire::Meshlet& meshlet) const {
  float largest = 0;
  for (const std::uint32_t bone : film.bones_of(meshlet.skin))
    for (const auto& row : bones_.matrices[bone].m)
      for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(row[c]));
  return largest > 0 ? std::ldexp(1.0f, -std::clamp(std::ilogb(largest), -100, 100)) : 1;
}

bool SegmentPlace::mirrors(const wire::PackedFilm& film, std::size_t piece) const {
  return shape::mirrors(has_skin() ? bones_.matrices[film.bones_of_piece(shape_, piece).front()] : matrix_);
}

shape::EyePatch SegmentPlace::patch(const wire::PackedFilm& film, std::size_t number) const {
  if (!has_skin()) return shape::to_eye(matrix_, film.patches_of(shape_)[number]);
  const auto move = [&](const wire::NetPoint& point) { return moved_point(film, point, bones_); };
  const wire::PatchStencils& stencils = film.net_patches_of(shape_)[number].stencils;
  shape::EyePatch moved;
  for (std::size_t point = 0; point < wire::kPatchPoints; ++point)
    std::ranges::copy(net_.bezier(film, stencils[point], move), moved.point[point]);
  return moved;
}

Bending SegmentPlace::bending(const wire::PackedFilm& film, std::size_t patch) const {
  if (!has_skin()) return {wire::SurfaceKind::patch};
  Bending bending{wire::SurfaceKind::net_patch};
  for (const std::uint32_t stencil : film.net_patches_of(shape_)[patch].stencils)
    bending.units += film.stencils()[stencil].term_count;
  return bending;
}

Bending SegmentPlace::bending(const wire::Meshlet& meshlet) const {
  if (!has_skin()) return {wire::SurfaceKind::meshlet};
  const std::uint64_t weights = std::uint64_t{meshlet.skin.bone_count} * meshlet.vertex_count;
  return {duals().empty() ? wire::SurfaceKind::skin_meshlet : wire::SurfaceKind::dual_meshlet, weights};
}

BoxCorners SegmentPlace::corners(const wire::PackedFilm& film, const wire::Meshlet& meshlet) const {
  if (!has_skin()) return corners_of(matrix_, meshlet.low, meshlet.high);
  return corners_of(
      bounds_.round(film.bones_of(meshlet.skin), meshlet.low, meshlet.high, pairs_of(film, meshlet, bone_pairs_)));
}

BoxCorners SegmentPlace::corners(const ShapeBoxes& boxes) const {
  const ShapeBoxes::Box& all = boxes.of(shape_);
  if (!has_skin()) return corners_of(matrix_, std::to_array(all.low), std::to_array(all.high));
  return corners_of(bounds_.round(boxes, shape_));
}

}  // namespace mars::geometry
