// What the layers of pictures (node/wire/pixel_format.h) show of surfaces: depth, normal, motion, segment. Plain
// arithmetic, for whatever instruction set.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "node/geometry/net_points.h"
#include "node/geometry/scene.h"
#include "node/geometry/segment_place.h"
#include "node/geometry/triangle.h"
#include "node/wire/still_plan.h"

namespace mars::geometry {

class SurfaceView {
 public:
  // `scene` outlives it.
  explicit SurfaceView(const Scene& scene) : scene_(scene) {}
  explicit SurfaceView(const Scene&&) = delete;

  // The frame that the scene is at. `motion`: whether points have theirs.
  void set_frame(std::uint32_t frame, bool motion);

  // What a sample of the triangle shows; x, y in 1/256 pixel.
  wire::SurfacePoint at(const Triangle& triangle, std::int32_t x, std::int32_t y) const;
  // Whether segments that stand still in the interval were elsewhere in the frame before, or were seen so.
  bool still_has_moved() const { return still_has_moved_; }

 private:
  // From eye space to that of the frame before; a skin has none for all of its points.
  struct Way {
    bool moves = false;
    bool has_skin = false;
    float m[3][4]{};
  };

  // A patch or meshlet with a skin as triangles in eye space, now and at the frame before, and its segment's bones.
  struct Bent {
    std::optional<std::uint32_t> patch, segment;  // their numbers; none: there is none yet
    std::vector<std::array<float, 3>> now, before;
    std::span<const wire::MeshTriangle> triangles;
    EyeBones bones_now, bones_before;
    NetPoints<float, 3> net;
    std::vector<std::uint8_t> bone_stays;  // by the segment's bones: 1 if it is where it was at the frame before
    bool stays = false;                    // all of it
  };

  struct Place {
    float eye[3];
    float pixel[2];  // of the whole picture
    float values[shape::kValues];
  };

  void find_ways(std::uint32_t frame);
  bool standing_bone_moved(std::size_t segment) const;
  Place place_of(const Triangle& triangle, std::int32_t x, std::int32_t y) const;
  void put_normal(const Triangle& triangle, const Place& place, float* normal) const;
  void put_motion(const Triangle& triangle, const Place& place, std::uint32_t segment, float* motion) const;
  void find_bent(std::uint32_t patch, std::uint32_t segment) const;
  void find_bones(std::uint32_t segment) const;
  void put_patch(const wire::Segment& segment, std::size_t number, const EyeBones& bones,
                 std::vector<std::array<float, 3>>& out) const;
  void put_before(const Place& place, float* eye) const;

  const Scene& scene_;
  std::uint32_t frame_ = 0;
  float to_world_[3][3]{};
  shape::Projection before_{};
  std::vector<Way> ways_;  // by segment; none: nothing has moved
  bool still_has_moved_ = false;
  mutable Bent bent_;  // of the point that was asked for last
};

}  // namespace mars::geometry
