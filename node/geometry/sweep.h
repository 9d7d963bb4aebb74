// What of the picture an interval's moving parts, and their shadows, may change in the course of its frames, before
// anything is drawn. Bounds, never too small.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "node/geometry/line_range.h"
#include "node/geometry/net_points.h"
#include "node/geometry/scene.h"
#include "node/geometry/skin_bounds.h"

namespace mars::geometry {

// Points of eye space, by axis, between which something lies.
struct SweptHull {
  static constexpr std::uint32_t kMostPoints = 16;

  float along[3][kMostPoints];
  std::uint32_t count;
};

// Room for what the segment with a skin that is swept takes, in the world.
struct SkinScratch {
  SkinBounds bones;
  NetPoints<double, 6> net;  // boxes, low then high
};

// Room for what shadows that are swept take, in the world.
struct ShadowScratch {
  std::vector<wire::Light> lights;
  std::vector<std::array<std::array<double, 3>, 2>> receivers;  // boxes, low then high
};

class Sweep {
 public:
  using Cover = std::function<void(const PictureBounds&)>;

  // Of the moving parts of the scene's interval at some of its frames. Calls cover() for what they cover of the
  // picture. `boxes` and what is behind `frames` are needed no longer.
  void begin(const Scene& scene, std::span<const std::uint32_t> frames, const ShapeBoxes& boxes, const Cover& cover);

  // Lines that the parts cover, and those that their shadows may touch.
  const LineRange& lines() const { return lines_; }
  // What casts shadows lies within these: one for each patch and meshlet at each frame, or, where these are many, for
  // each segment, at several frames.
  std::span<const SweptHull> casters() const { return casters_; }

 private:
  void take_in(const LineRange& lines);

  std::vector<SweptHull> casters_;
  SkinScratch scratch_;
  ShadowScratch shadow_scratch_;
  LineRange lines_{0, 0};
};

}  // namespace mars::geometry
