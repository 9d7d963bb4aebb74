// The first step of a frame: a node's share of the patches and meshlets, scattered, becomes edge boxes. Dicing and
// set-up are the product's, whose edge boxes hold pixels; those without are added.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "node/tessellator.h"
#include "tests/bench/tables/machine1992/crossings.h"
#include "tests/bench/tables/machine1992/messages.h"
#include "tests/bench/tables/machine1992/work.h"

namespace mars::machine1992 {

class Share {
 public:
  explicit Share(const wire::PackedFilm& film);

  // All edge boxes of the scatter's part of the scene; of a patch's triangles the first come first. `stationary`: those
  // of parts that stand still too.
  const std::vector<SentBox>& edge_boxes(const geometry::Scene& scene, const node::Scatter& scatter, bool stationary,
                                         WorkCounts& work);

 private:
  node::Tessellation tessellate(const geometry::Scene& scene, const node::Scatter& scatter, bool stationary,
                                wire::WorkCounts& counts);
  void append_empty(bool moving);

  node::Tessellator tessellator_;
  Crossings crossings_;
  std::vector<std::uint8_t> all_lines_;
  std::vector<raster::LineLoad> loads_;
  std::vector<geometry::Triangle> memory_;
  raster::Arena arena_;
  std::vector<SentBox> boxes_;
};

}  // namespace mars::machine1992
