// The scanlines that polygons cross. "Find and store the intersection points of each polygon with the scanlines of the
// image" (thesis 4.2): a polygon has an edge box on each, also where no pixel's centre lies between its two ends. The
// product makes none there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "node/geometry/meshlets.h"
#include "node/geometry/scene.h"
#include "node/shape/dice.h"
#include "node/tessellator.h"

namespace mars::machine1992 {

class Crossings {
 public:
  explicit Crossings(const wire::PackedFilm& film);

  // Of the scatter's part of the scene. `stationary`: with parts that stand still.
  void count(const geometry::Scene& scene, const node::Scatter& scatter, bool stationary);

  std::uint64_t polygons() const { return polygons_; }  // seen or not
  std::uint64_t drawn() const { return drawn_; }        // that face the eye and cross a line
  std::span<std::uint32_t> on_lines(bool moving) { return lines_[moving ? 1 : 0]; }  // by line: how many cross it

 private:
  // Of a segment.
  struct Sides {
    bool moving, one_sided, mirrored;
  };

  void add_segment(const geometry::Scene& scene, std::size_t segment, const node::Scatter& scatter);
  void add(const shape::Surface& surface, const Sides& sides);

  shape::SamplePattern pattern_;
  shape::Dicer dicer_;
  geometry::MeshletPlacer placer_;
  std::uint64_t polygons_ = 0;
  std::uint64_t drawn_ = 0;
  std::vector<std::uint32_t> lines_[2];  // of stationary and of moving parts
};

}  // namespace mars::machine1992
