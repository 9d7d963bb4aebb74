// Counts what the shadows of a frame take, as forecasts need it: which points are lit on some lines of the picture, and
// to which of the sampled lines each caster matters. Lights that have a size are not counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/geometry/scene.h"
#include "node/geometry/sweep.h"
#include "node/geometry/triangle.h"
#include "node/raster/still_marks.h"
#include "node/shadow/casters.h"
#include "node/shadow/light_views.h"
#include "node/shadow/points.h"
#include "node/wire/frame_counts.h"

namespace mars::node {

// What is seen on a line: by sample of the pattern, `stride` apart, and by column.
struct SeenLine {
  std::uint32_t number;
  const std::uint32_t* ids;  // shading::kNoTriangle: nothing
  const float* depths;
  std::size_t stride;
  const geometry::Triangle* triangles;  // by id
};

class ShadowCounter {
 public:
  using Casting = shadow::Casting;

  ShadowCounter(const geometry::Scene& scene, simd::InstructionSet set);

  // The scene's frame, of which one line in `step` will be added.
  void begin(const geometry::Scene& scene, wire::FrameKind kind, std::uint32_t step);
  // Lines ascend. Returns the points of samples on it, of all lights.
  double add(const geometry::Scene& scene, Casting seen, const SeenLine& line);
  // When all are added: the frame's casters, and of an inbetween the still points that moving ones may block.
  void count(const geometry::Scene& scene, wire::FrameCounts& counts);
  // After count() of a keyframe: marks what of the picture shadows may change, all of it where lights have a size.
  void mark_shaded(const geometry::Scene& scene, const geometry::Sweep& sweep, raster::StillMarks& marks);
  // Where surfaces go that are diced for the camera.
  shadow::DicedSurfaces& diced() { return diced_; }

 private:
  static constexpr std::uint32_t kColumns = shadow::kPointLanes;  // of a stretch

  // Lit points of a stretch of an added line.
  struct Stretch {
    std::uint32_t line;
    shadow::GridBox box;
    double points;
  };
  // Those that one view sees, by place of the line among those added, then by column.
  struct Stretches {
    std::vector<Stretch> all;
    shadow::BoxTree tree;
  };
  struct Light {
    geometry::EyeLight light;
    shadow::LightViews views;
    std::array<std::vector<Stretches>, 2> seen;  // by Casting, then by view
  };
  // On which of the added lines a caster matters, and on how many grids.
  struct Reach {
    std::uint32_t first = 0xffffffff, last = 0;
    double views = 0;
  };

  bool is_lit(const geometry::Scene& scene, const geometry::EyeLight& light, const SeenLine& line, std::uint32_t column,
              std::size_t sample) const;
  void add_stretch(Light& light, Casting seen, const SeenLine& line, std::uint32_t first, std::uint32_t active,
                   double points);
  void finish(Stretches& stretches) const;
  void count_casters(const geometry::Scene& scene, Light& light, Casting casting, std::span<const Casting> onto,
                     wire::FrameCounts& counts);
  double find_kept(const geometry::Scene& scene, Light& light);
  void extend(Light& light, std::span<const Casting> onto, std::size_t view, const shadow::GridBox& box, Reach& reach);
  template <typename Hull>
  shadow::GridBox project(const shadow::LightView& view, const Hull& hull);

  const shadow::ShadowKernels& kernels_;
  shadow::DicedSurfaces diced_;
  shadow::CasterStream casters_;
  std::uint32_t stretches_;  // of a line
  std::uint32_t step_ = 1;
  bool keyframe_ = true;
  std::vector<Light> lights_;  // those without size
  std::array<std::vector<std::int32_t>, 2> grid_;
  std::vector<float> grid_z_;
  std::vector<std::uint32_t> found_;
};

}  // namespace mars::node
