// Which pairs of a band's points casters block: puts the points on the grids of each light's views, and has casters
// stream by.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "node/geometry/scene.h"
#include "node/geometry/sweep.h"
#include "node/raster/still_marks.h"
#include "node/shadow/band.h"
#include "node/shadow/casters.h"
#include "node/shadow/grid_caster.h"
#include "node/shadow/light_views.h"
#include "node/shadow/points.h"
#include "node/shadow/shadow_plan.h"
#include "node/shadow/shafts.h"

namespace mars::shadow {

// What was done since it was asked last.
struct CastCounts {
  std::uint64_t points = 0;          // put on a grid
  std::uint64_t surfaces = 0;        // diced
  std::uint64_t diced_vertices = 0;  // of diced surfaces
  std::uint64_t vertices = 0;        // put on a grid
  std::uint64_t triangles = 0;       // set up
};

class ShadowCaster {
 public:
  // `plan`: of the scene's film.
  ShadowCaster(simd::InstructionSet set, const geometry::Scene& scene, const ShadowPlan& plan);

  // The lights as they are in the scene's frame. `look` is called now and then.
  void begin(const geometry::Scene& scene, const std::function<void()>& look);
  std::uint32_t lights() const { return static_cast<std::uint32_t>(lights_.size()); }
  std::uint32_t pairs_a_sample(std::uint32_t light) const { return shadow::pairs_a_sample(samples_, has_size(light)); }

  // Lets casters block pairs: still ones of the layers `drawn`, moving ones of `drawn` and of `kept`, which knows
  // what still ones block.
  using Layers = std::span<Layer* const>;
  void cast(const geometry::Scene& scene, Layers drawn, Layer& kept);
  // Where surfaces go that are diced for the camera.
  DicedSurfaces& diced() { return diced_; }

  // Marks the squares of what stands still whose points casters may block that are somewhere in the sweep, as far as
  // their shadows may reach lines.
  void mark_shaded(const geometry::Sweep& sweep, const Layer& still, raster::StillMarks& marks);

  // Of what stands still throughout an interval on the layer's lines: remembers where its points are.
  void bound_still(const Layer& still);
  void forget_still();
  bool knows_still(const geometry::LineRange& lines) const {
    return knows_still_ && still_lines_.first == lines.first && still_lines_.last == lines.last;
  }
  // Leaves of `tiles`, squares of the still layer, those whose points the scene's moving casters may block; all where
  // that is not known.
  void find_shaded(const geometry::Scene& scene, std::vector<std::uint32_t>& tiles);

  CastCounts take_counts() { return std::exchange(counts_, {}); }

 private:
  // Squares' points, seen from a light's middle.
  struct TileBounds {
    BoxTree tree;
    std::vector<std::uint32_t> tiles;  // of each box
    ShaftReach reach;
  };

  bool has_size(std::uint32_t light) const { return lights_[light].points > 1; }
  const PairVectors& vectors_of(std::uint32_t light) const { return has_size(light) ? soft_ : hard_; }
  PointSource source_of(std::uint32_t light, std::uint32_t point) const;
  PointSource samples_of(std::uint32_t light) const;
  std::span<const LightView> views_of(std::uint32_t light, std::uint32_t point) const;
  void bound(std::uint32_t light, const Layer& layer, std::span<const std::uint32_t> tiles,
             std::vector<TileBounds>& faces) const;
  GridBox bound_tile(std::uint32_t light, const LightView& view, const Layer& layer, std::uint32_t tile) const;
  template <typename Visit>
  void visit_shaded(std::uint32_t light, const Hull& hull, std::vector<TileBounds>& faces, const Visit& visit);

  // Points of some layers, by face of a light.
  using Faces = std::vector<Points>;

  void cast_from_point(const geometry::Scene& scene, std::uint32_t light, Layers drawn, Layer& kept);
  void cast_from_all(const geometry::Scene& scene, Casting casting, std::uint32_t light, Layers onto);
  void begin_points(std::span<const LightView> views, Faces& faces);
  void finish_points(Faces& faces);
  void put_points(const PointSource& source, std::span<const LightView> views, Layers onto, Faces& faces);
  void forget_points(Faces& faces);
  void stream(const geometry::Scene& scene, Casting casting, std::span<const LightView> views,
              std::span<Faces* const> onto);
  std::span<const ChunkCaster> next_casters(const CasterStream::Matters& matters);
  void block(std::span<const ChunkCaster> casters, std::span<const LightView> views, Faces& faces);
  void block(const ChunkCaster& caster, const LightView& view, Points& points);

  const ShadowKernels& kernels_;
  shape::SamplePattern pattern_;
  std::uint32_t samples_;
  PairVectors hard_, soft_;
  DicedSurfaces diced_;
  CasterStream casters_;
  std::size_t points_bytes_;  // as in ShadowPlan
  std::vector<LightViews> lights_;
  Faces drawn_points_, kept_points_;
  GridCaster grid_;
  Shafts shafts_;
  // By face, or by light and face: a light may have fewer faces now than there is room for.
  std::vector<TileBounds> bounds_;  // of a light
  std::vector<std::vector<TileBounds>> still_bounds_;
  bool knows_still_ = false;               // still_bounds_ are of the interval
  geometry::LineRange still_lines_{0, 0};  // that still_bounds_ are of
  std::vector<Layer*> all_layers_;
  std::vector<std::uint32_t> marked_tiles_;
  std::vector<std::uint32_t> found_;
  std::vector<std::uint8_t> is_shaded_;  // by square of the picture
  std::function<void()> look_;
  CastCounts counts_;
};

}  // namespace mars::shadow
