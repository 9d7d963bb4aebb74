// What a node does for a frame, in seconds of its processor and in bytes: its part of a keyframe in a group of nodes,
// or an inbetween.
#pragma once

#include <cstdint>
#include <vector>

#include "host/experiments/forecast/costs.h"
#include "host/experiments/forecast/film_counts.h"
#include "host/experiments/forecast/setting.h"
#include "node/group/mapping.h"

namespace mars::forecast {

// The pixels of a node's part of a frame, on their way to the host.
struct StripCosts {
  double seconds = 0;  // of drawing, all strips
  double bytes = 0;
  double pasting = 0;  // seconds of the host
  std::uint32_t count = 1;
};

struct NodePart {
  double dice = 0;           // until the group's sum
  double exchange = 0;       // mapping, messages and filling
  double exchange_wait = 0;  // for the network, beyond
  StripCosts strips;
  double compose = 0;     // of a node that writes files: pasting and encoding
  double bands = 0;       // encoded ones, sent and received
  double bands_wait = 0;  // for the network, beyond
  double still = 0;       // lines for inbetweens, sent and received
  double still_wait = 0;  // for the network, beyond
  double bytes_to_nodes = 0;
  double memory = 0;       // bytes of its arena
  double made_memory = 0;  // of this memory, what the node makes itself
};

struct GroupKeyframe {
  std::vector<NodePart> nodes;
  double sum = 0;     // seconds of the group's sum, once all have come to it
  double passes = 1;  // over its lines
};

// What the host does of a task: seconds to show its background in a buffer that shows another, as far as a frame needs
// it; and of its sinks, seconds for the file of each frame.
struct HostCosts {
  double background = 0;
  std::vector<double> files{};
};

class FrameCosts {
 public:
  // `nodes`: of all groups.
  FrameCosts(const Setting& setting, int nodes);

  // Of a group of `nodes`, of which `contributors` contribute, and which then draw `inbetweens`.
  GroupKeyframe keyframe(const wire::FrameCounts& counts, int nodes, int contributors, std::size_t inbetweens) const;
  // What inbetweens after such a keyframe draw again on a node of a group of `nodes`: stationary parts on lines that
  // are not kept.
  FrameTotals drawn_again(const wire::FrameCounts& keyframe, int nodes) const;
  // Bytes that a machine keeps of such a keyframe for inbetweens of a group of `nodes`.
  double still_bytes(const wire::FrameCounts& keyframe, int nodes) const;
  // Of a node.
  double shadow_bytes() const { return static_cast<double>(memory_.shadows); }
  // Of each of `sharers` nodes that draw it together.
  NodePart inbetween(const FrameTotals& totals, const FrameTotals& again, int sharers = 1) const;
  // Seconds of a processor that writes a whole file, which is encoded; its bytes.
  double writing() const;
  double file_bytes() const { return setting_.platform.file_part * height() * line_bytes(); }
  HostCosts host_costs(const TaskCounts& task, const wire::FrameCounts& keyframe) const;
  const Costs& costs() const { return costs_; }

 private:
  struct Homes;

  struct StillLines {
    double bytes = 0;
    double messages = 0;
  };
  StillLines still_lines(const geometry::LineRange& home, const wire::FrameCounts& counts,
                         const wire::StillPlan& plan) const;
  FrameTotals shared(const FrameTotals& whole, int sharers) const;
  double dicing(const wire::UnitCounts& made) const;
  double setting_up(const wire::UnitCounts& made) const;
  wire::UnitCounts drawn_units(const FrameTotals& totals) const;
  double keyframe_drawing(const FrameTotals& totals, const wire::FrameCounts& counts,
                          const geometry::LineRange& lines) const;
  StripCosts strips(const FrameTotals& totals, double seconds) const;
  double casting(const FrameTotals& totals, const wire::FrameCounts& counts, const geometry::LineRange& lines,
                 int nodes) const;
  double lines_of_band(const FrameTotals& totals, double lines) const;
  double pasting(const FrameTotals& totals) const;
  double background(const wire::FrameCounts& keyframe) const;
  double encoding(double lines) const;
  void add_bands(GroupKeyframe& keyframe, const Homes& homes, const wire::FrameCounts& counts, int contributors,
                 std::size_t inbetweens) const;
  double saving(const FrameTotals& totals) const;
  bool is_kept(const wire::FrameCounts& keyframe, std::uint32_t line, const wire::StillPlan& plan) const;
  double kept_groups(const wire::LineCounts& line) const;
  double kept_bytes(const wire::LineCounts& line) const;
  wire::StillPlan still_plan(int nodes) const;
  double made_bytes(const wire::UnitCounts& made) const;
  double arena_bytes() const;
  double passes(const wire::UnitCounts& made, double home_boxes, bool travels) const;
  void add_dicing(GroupKeyframe& keyframe, const Homes& homes, const std::vector<wire::UnitCounts>& made) const;
  void add_sum(GroupKeyframe& keyframe, int nodes) const;
  void add_exchange(GroupKeyframe& keyframe, const Homes& homes, const std::vector<wire::UnitCounts>& made,
                    int contributors) const;
  void add_still(GroupKeyframe& keyframe, const Homes& homes, const wire::FrameCounts& counts,
                 std::size_t inbetweens) const;
  int nodes_on_a_computer(int nodes) const;
  double pixel_bytes() const { return static_cast<double>(wire::pixel_bytes(setting_.pixels())); }
  double line_bytes() const { return setting_.film.settings().width * pixel_bytes(); }
  double height() const { return setting_.film.settings().height; }

  const Setting setting_;
  const Costs costs_;
  const farm::NodeMemory memory_;  // of a node
  const std::uint32_t band_lines_;
};

}  // namespace mars::forecast
