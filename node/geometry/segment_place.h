// Where a segment is in eye space at its scene's frame: its one matrix moves it, or, where it has a skin, its bones.
// What bounds it bounds either (skin_bounds.h); Bezier points of nets stay between the nets' points.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "node/geometry/net_points.h"
#include "node/geometry/scene.h"
#include "node/geometry/skin_bounds.h"
#include "node/shape/bezier.h"
#include "node/shape/dual_quaternion.h"
#include "node/wire/film.h"
#include "node/wire/frame_counts.h"

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

// The bones of a segment with a skin, to eye space, as nodes blend them.
struct EyeBones {
  std::vector<shape::EyeMatrix> matrices;
  std::vector<shape::DualBone<float>> duals;  // the same, where dual quaternions are blended; else none

  // Room for `count` bones, whatever they are.
  void begin(wire::Blend blend, std::size_t count);
  void put(std::size_t bone, const shape::EyeMatrix& matrix);
};

// The matrix of point number `point` of `points` that have a skin: the blend of its bones in the skin's order. It
// begins with 0, so a bone without weight changes no bit of it, and points that skins with different bones share stay
// the same.
shape::EyeMatrix blended(const wire::PackedFilm& film, const wire::Skin& skin, std::uint32_t point,
                         std::uint32_t points, const EyeBones& bones);

// Where bones move a net's point.
std::array<float, 3> moved_point(const wire::PackedFilm& film, const wire::NetPoint& point, const EyeBones& bones);

// How bones bend a patch or meshlet, and the terms of means, or weights of vertices, by which they do.
struct Bending {
  wire::SurfaceKind kind;
  std::uint64_t units = 0;
};

class SegmentPlace {
 public:
  // Of the segment, until the next call.
  void find(const Scene& scene, std::size_t segment);

  bool has_skin() const { return !bones_.matrices.empty(); }
  // Whether it turns one of its shape's patches or meshlets inside out; of a skin, whether the piece's first bone does.
  bool mirrors(const wire::PackedFilm& film, std::size_t piece) const;
  // Of a rigid segment.
  const shape::EyeMap& map() const { return map_; }
  // Of a skin, by number.
  std::span<const shape::EyeMatrix> bones() const { return bones_.matrices; }
  std::span<const shape::DualBone<float>> duals() const { return bones_.duals; }  // none where the blend is linear
  // EyeSkin::scale of a meshlet with a skin: a power of two by its own bones, so others change no bit of it, and
  // meshlets that share vertices give these the same normals.
  float scale(const wire::PackedFilm& film, const wire::Meshlet& meshlet) const;

  // One of its shape's patches, by its number in the shape.
  shape::EyePatch patch(const wire::PackedFilm& film, std::size_t number) const;
  Bending bending(const wire::PackedFilm& film, std::size_t patch) const;
  Bending bending(const wire::Meshlet& meshlet) const;
  // Round one of its shape's meshlets, and round all of its shape.
  BoxCorners corners(const wire::PackedFilm& film, const wire::Meshlet& meshlet) const;
  BoxCorners corners(const ShapeBoxes& boxes) const;

 private:
  void find_bones(const Scene& scene, std::size_t segment);

  std::uint32_t shape_ = 0;
  shape::EyeMatrix matrix_{};
  shape::EyeMap map_{};
  EyeBones bones_;
  std::span<const BonePairs> bone_pairs_;
  SkinBounds bounds_;
  mutable NetPoints<float, 3> net_;  // patches ask for the same points
};

}  // namespace mars::geometry
