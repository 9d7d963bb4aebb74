// Counts what the shadows of a frame take, as forecasts need it: which points are lit on some lines of the picture, and
// to which of the sampled lines each caster matters. Of a light that has a size, grids of a few points stand for those
// of all. Points that casters block count as if they were open, and casters of a light as one chunk.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/geometry/scene.h"
#include "node/geometry/triangle.h"
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
  // Lines ascend. Returns the points of samples on it that are put on grids, of all lights.
  double add(const geometry::Scene& scene, Casting seen, const SeenLine& line);
  // When all are added: the frame's casters, and of an inbetween the still points that moving ones may block.
  void count(const geometry::Scene& scene, wire::FrameCounts& counts);
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
    std::vector<shadow::LightView> counted{};      // of one point, or of some that stand for all
    double points_each = 1;                        // of the light, for which each of them stands
    std::array<std::vector<Stretches>, 2> seen{};  // by Casting, then by counted view
    std::array<Stretches, 2> seen_by_middle{};     // of a light with size, by Casting

    bool has_size() const { return views.points > 1; }
    // Whether its middle's view says what may be before the points of all its views.
    bool has_bounds() const { return !has_size() || !views.middle.has_place; }
  };
  // On which of the added lines a caster matters; on how many grids there may be points before which it is, and are.
  struct Reach {
    std::uint32_t first = 0xffffffff, last = 0;
    double near = 0, views = 0;

    void add_line(std::uint32_t line) { first = std::min(first, line), last = std::max(last, line); }
  };

  bool is_lit(const geometry::Scene& scene, const geometry::EyeLight& light, const SeenLine& line, std::uint32_t column,
              std::size_t sample) const;
  void add_stretch(Light& light, Casting seen, const SeenLine& line, std::uint32_t first, std::uint32_t active,
                   double points);
  void add_light(const geometry::EyeLight& light, const geometry::Scene& scene);
  Stretch stretch_on(const Light& light, const shadow::LightView& view, const SeenLine& line, std::uint32_t first,
                     std::uint32_t active, double points) const;
  void finish(Stretches& stretches) const;
  void count_casters(const geometry::Scene& scene, Light& light, Casting casting, std::span<const Casting> onto,
                     wire::FrameCounts& counts);
  double count_kept(const geometry::Scene& scene);
  void find_shaded(const geometry::Scene& scene, Light& light);
  void mark_shaded(const shadow::LightView& view, const shadow::Hull& hull, float spread, Stretches& still);
  Reach reach_of(const shadow::Hull& hull, Light& light, std::span<const Casting> onto);
  bool extend(Stretches& stretches, const shadow::GridBox& box, float spread, Reach& reach);
  shadow::GridBox project(const shadow::LightView& view, const shadow::Hull& hull);

  const shadow::ShadowKernels& kernels_;
  shadow::DicedSurfaces diced_;
  shadow::CasterStream casters_;
  std::uint32_t stretches_;  // of a line
  std::uint32_t height_;     // of the picture
  std::uint32_t step_ = 1;
  bool keyframe_ = true;
  std::vector<Light> lights_;
  std::vector<std::uint8_t> is_shaded_;  // by stretch
  std::array<std::vector<std::int32_t>, 2> grid_;
  std::vector<float> grid_z_;
  std::vector<std::uint32_t> found_;
};

}  // namespace mars::node
