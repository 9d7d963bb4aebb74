// Counts what the shadows of a frame take, as forecasts need it: which points are lit on some lines of the picture, and
// to which of the sampled lines each caster matters. Of a light that has a size, grids of a few points stand for those
// of all; its points are put for each chunk of casters, as if those before blocked none, where shafts meet the casters'
// boxes.
#pragma once

#include <algorithm>
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
#include "node/shadow/grid_caster.h"
#include "node/shadow/light_views.h"
#include "node/shadow/points.h"
#include "node/shadow/shafts.h"
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

  // Before surfaces are diced for the camera.
  void begin_frame(bool keyframe);
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
  static constexpr std::uint32_t kColumns = shadow::kPointLanes;  // that are added at a time
  static constexpr std::uint32_t kSquare = 4;                     // columns of a stretch

  // Lit points of a stretch of an added line.
  struct Stretch {
    std::uint32_t line;
    shadow::PointVector seen;  // of the first sample
    double points;             // of all
  };
  // What is seen of it: 1 / w by column, of those that count.
  struct SeenStretch {
    std::uint32_t line, first;  // column
    std::uint32_t active;       // one bit a column
    const float* depths;
    double points;
  };
  // Those that one view sees, by place of the line among those added, then by column.
  struct Stretches {
    std::vector<Stretch> all{};
    shadow::Points points{};             // one vector each
    std::vector<std::uint8_t> is_met{};  // by shafts of the chunk's casters
  };
  struct Light {
    geometry::EyeLight light;
    shadow::LightViews views;
    std::vector<shadow::LightView> counted{};                // of one point, or of some that stand for all
    std::vector<std::uint32_t> counted_points{};             // their numbers
    double points_each = 1;                                  // of the light, for which each of them stands
    std::array<std::vector<Stretches>, 2> seen{};            // by Casting, then by counted view
    std::array<std::vector<Stretches>, 2> seen_by_middle{};  // of a light with size, by Casting and face
    std::vector<shadow::ShaftReach> reach{};                 // by face, of the casters that are counted
    std::array<double, 2> put{};                             // points of a light with size that are put, by Casting

    bool has_size() const { return views.points > 1; }
    // Whether its middle says which still points moving casters may shade.
    bool has_bounds() const { return !has_size() || !views.middle.front().has_place; }
  };
  // Of the added lines.
  struct Lines {
    std::uint32_t first = 0xffffffff, last = 0;

    bool any() const { return first <= last; }
    void add(std::uint32_t line) { first = std::min(first, line), last = std::max(last, line); }
  };
  // On which a caster may matter, and those whose points it may be before; of a light with size, whether shafts meet
  // it.
  struct Reach {
    Lines lines, put;
    bool matters = true;
  };

  bool is_lit(const geometry::Scene& scene, const geometry::EyeLight& light, const SeenLine& line, std::uint32_t column,
              std::size_t sample) const;
  void add_stretch(Light& light, Casting seen, const SeenLine& line, std::uint32_t first, std::uint32_t active,
                   double points);
  void add_light(const geometry::EyeLight& light, const geometry::Scene& scene);
  std::uint32_t using_point(const Light& light, std::size_t view, std::uint32_t first, std::uint32_t line) const;
  Stretch stretch_on(const shadow::LightView& view, const shadow::PointFrame& frame, const SeenStretch& seen) const;
  void finish(Stretches& stretches);
  void count_casters(const geometry::Scene& scene, Light& light, Casting casting, std::span<const Casting> onto,
                     wire::FrameCounts& counts);
  wire::DicedBy diced_by(const shadow::ChunkCaster& caster, Casting casting);
  void find_reach(Light& light, std::span<const Casting> onto) const;
  void put_met(Light& light, std::span<const Casting> onto);
  void widen(const std::vector<Stretch>& all, std::vector<std::uint8_t>& is_met) const;
  bool meet_shafts(const shadow::ChunkCaster& caster, Light& light, std::span<const Casting> onto, Reach& reach);
  bool touch_all(Stretches& stretches, Lines& put);
  bool touch(const shadow::LightView& view, const shadow::Shaft& shaft, const shadow::ChunkCaster& caster,
             const shadow::GridBox& box, Stretches& stretches, Lines& put);
  double grids_behind(const shadow::ChunkCaster& caster, Light& light, std::span<const Casting> onto);
  // A keyframe's points of both kinds lie on the same grid; so do all of a light that has a size.
  bool is_one_grid(const Light& light) const { return keyframe_ || light.has_size(); }
  void scale_points(Casting seen, wire::SeenCounts wire::LineCounts::*of, std::vector<wire::LineCounts>& lines) const;
  double count_kept(const geometry::Scene& scene);
  void find_shaded(const geometry::Scene& scene, Light& light);
  template <typename Hull, typename Visit>
  void visit_shaded(Light& light, const Hull& hull, const Visit& visit);
  template <typename Hull, typename Visit>
  void visit_shaded(const shadow::LightView& view, const Hull& hull, float spread, Stretches& still,
                    const Visit& visit);
  Reach reach_of(const shadow::Hull& hull, Light& light, std::span<const Casting> onto);
  void extend(Stretches& stretches, const shadow::GridBox& box, float spread, Lines& lines);
  template <typename Hull>
  shadow::GridBox project(const shadow::LightView& view, const Hull& hull);

  const shadow::ShadowKernels& kernels_;
  shadow::DicedSurfaces diced_;
  std::vector<std::uint8_t> is_needed_;  // by patch: shadows of the interval needed it as a still caster
  shadow::CasterStream casters_;
  std::uint32_t stretches_;  // of a line
  std::uint32_t height_;     // of the picture
  std::uint32_t step_ = 1;
  bool keyframe_ = true;
  std::vector<Light> lights_;
  std::vector<std::uint8_t> is_shaded_;  // by stretch
  shadow::Layer nowhere_{};              // that points are of
  shadow::GridCaster grid_;
  std::vector<std::uint8_t> touched_;
  std::vector<std::uint32_t> found_;
};

}  // namespace mars::node
