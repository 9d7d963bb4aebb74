// What the nodes of a group have to do for a keyframe, and to give each other, whatever that costs: rehearsals of the
// same groups on other costs share it.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "host/experiments/forecast/film_counts.h"
#include "host/experiments/forecast/steps.h"
#include "node/group/mapping.h"

namespace mars::forecast {

struct NodeLoad {
  wire::UnitCounts made;   // its patches and meshlets, with their triangles
  FrameTotals seen;        // on its lines
  wire::UnitCounts drawn;  // there
  wire::UnitCounts casters;
  std::vector<double> strips;  // bytes of pixels and runs in each
  double memory = 0;           // bytes of its arena
  double made_memory = 0;      // of this memory, what its own triangles take
  // Others' surfaces with edge boxes that may be on its lines, and their triangles: if it makes them instead of
  // receiving them.
  wire::UnitCounts again, set_up_again;
};

struct KeyframeLoad {
  std::vector<NodeLoad> nodes;
  std::vector<geometry::LineRange> homes;  // of the nodes
  double passes = 1;                       // over their lines
  // Triangles, by node; none: they are not sent.
  std::vector<std::vector<Parcel>> parcels{};
  wire::UnitCounts with_boxes, without_boxes;  // all surfaces with edge boxes, and the others
  std::vector<std::vector<double>> still{};    // messages of each node with lines for inbetweens
  std::vector<NodeBands> bands{};              // of files, where nodes write them; without the seconds
};

// Loads by what they are of, each made once, also where several rehearsals want it at a time.
class KeyframeLoads {
 public:
  using Key = std::array<std::size_t, 5>;

  std::shared_ptr<const KeyframeLoad> of(const Key& key, const std::function<KeyframeLoad()>& make);

 private:
  struct Entry {
    std::once_flag once;
    std::shared_ptr<const KeyframeLoad> load;
  };

  std::mutex mutex_;
  std::map<Key, Entry> entries_;
};

}  // namespace mars::forecast
