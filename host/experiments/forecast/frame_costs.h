// What a node does for a frame, in seconds of its processor and in bytes: its part of a keyframe in a group of nodes,
// or an inbetween.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "hal/collectives/group.h"
#include "host/experiments/forecast/costs.h"
#include "host/experiments/forecast/film_counts.h"
#include "host/experiments/forecast/frame_loads.h"
#include "host/experiments/forecast/setting.h"
#include "host/experiments/forecast/steps.h"

namespace mars::forecast {

// The pixels of a node's part of a frame, on their way to the host.
struct StripCosts {
  double seconds = 0;  // of drawing, all strips
  double bytes = 0;
  double pasting = 0;              // seconds of the host
  std::vector<double> parts{1.0};  // of each strip, of all of that

  std::uint32_t count() const { return static_cast<std::uint32_t>(parts.size()); }
};

struct NodePart {
  double dice = 0;  // until the group's sum
  double map = 0;   // lines to homes
  StripCosts strips;
  double compose = 0;      // of a node that writes files: pasting, and of an inbetween encoding
  double memory = 0;       // bytes of its arena
  double made_memory = 0;  // of this memory, what the node's own triangles take
  double team_bytes = 0;   // of an inbetween's bands, to the node of its team that writes the file
};

struct GroupKeyframe {
  std::vector<NodePart> nodes;
  Exchange sum, triangles;
  std::vector<double> again;  // seconds of each node, if it makes others' triangles instead of receiving them
  std::shared_ptr<const KeyframeLoad> load;
};

// What its nodes give each other once it is drawn.
struct KeyframeGifts {
  Exchange still;  // lines for inbetweens
  Exchange bands;  // of files, where nodes write them
};

// Who draws a keyframe, and then its inbetweens.
struct KeyframeGroup {
  collectives::Group nodes;
  int contributors;                 // of the nodes, to the keyframe
  std::vector<std::uint8_t> draws;  // of the nodes: 1: inbetweens
  int writer;                       // of the keyframe's file, within the group

  int count() const { return nodes.count; }
  bool has_inbetweens() const { return std::ranges::count(draws, 1) > 0; }
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

  // It is the same whoever of the group draws inbetweens and writes the file.
  KeyframeLoad load(const KeyframeCounts& counts, const SurfaceTable& surfaces, const KeyframeGroup& group) const;
  GroupKeyframe keyframe(std::shared_ptr<const KeyframeLoad> load, const KeyframeCounts& counts,
                         const KeyframeGroup& group) const;
  KeyframeGifts gifts(const KeyframeLoad& load, const KeyframeGroup& group) const;
  // What inbetweens after such a keyframe draw again on a node of a group of `nodes`: stationary parts on lines that
  // are not kept.
  FrameTotals drawn_again(const wire::FrameCounts& keyframe, int nodes) const;
  // Bytes that a machine keeps of such a keyframe for inbetweens of a group of `nodes`.
  double still_bytes(const wire::FrameCounts& keyframe, int nodes) const;
  // Of a node.
  double shadow_bytes() const { return static_cast<double>(memory_.shadows); }
  // Of each of `sharers` nodes that draw it together.
  NodePart inbetween(const FrameTotals& totals, const FrameTotals& again, int sharers = 1) const;
  // Seconds of a processor that encodes lines.
  double encoding(double lines) const;
  // And that writes a whole file, which is encoded; its bytes.
  double writing() const;
  double file_bytes() const { return setting_.platform.file_part * height() * line_bytes(); }
  // Kinds of work that the film's frames have.
  std::vector<wire::Work> kinds_of_work(const FilmCounts& counts) const;
  HostCosts host_costs(const TaskCounts& task, const wire::FrameCounts& keyframe) const;
  const Costs& costs() const { return costs_; }

 private:
  static constexpr double kBoxMargin = 5;  // lines by which a patch's box is too tall

  std::vector<double> still_messages(const geometry::LineRange& home, const wire::FrameCounts& counts) const;
  FrameTotals shared(const FrameTotals& whole, int sharers) const;
  double dicing(const wire::UnitCounts& made) const;
  double setting_up(const wire::UnitCounts& made) const;
  wire::UnitCounts drawn_units(const FrameTotals& totals) const;
  NodePart part_of(const NodeLoad& load, const KeyframeLoad& all) const;
  std::vector<double> making_again(const KeyframeLoad& load) const;
  wire::UnitCounts drawn_in_keyframe(const FrameTotals& seen, const wire::FrameCounts& counts,
                                     const geometry::LineRange& lines) const;
  StripCosts strips(const FrameTotals& totals, double seconds, std::vector<double> sizes) const;
  double strip_bytes(const wire::LineCounts& line) const;
  std::vector<double> strip_sizes(double bytes) const;
  std::vector<double> strip_sizes(const wire::FrameCounts& counts, const geometry::LineRange& lines) const;
  wire::UnitCounts casters(const FrameTotals& seen, const wire::FrameCounts& counts, const geometry::LineRange& lines,
                           int nodes) const;
  double lines_of_band(const FrameTotals& totals, double lines) const;
  double pasting(const FrameTotals& totals) const;
  double background(const wire::FrameCounts& keyframe) const;
  NodeBands bands_of(const std::vector<geometry::LineRange>& homes, std::size_t node, const wire::FrameCounts& counts,
                     bool has_inbetweens) const;
  double saving(const FrameTotals& totals, bool restores) const;
  bool is_kept(const wire::FrameCounts& keyframe, std::uint32_t line, const wire::StillPlan& plan) const;
  bool has_groups() const;
  double packed_bytes(const wire::LineCounts& line) const;
  double kept_bytes(const wire::LineCounts& line) const;
  std::vector<std::uint64_t> line_weights(const wire::FrameCounts& counts, bool has_inbetweens) const;
  wire::StillPlan still_plan(int nodes) const;
  double made_bytes(const wire::UnitCounts& made) const;
  double fresh_bytes(const wire::UnitCounts& made) const;
  double arena_bytes() const;
  double passes(const wire::UnitCounts& made, double home_boxes, bool travels) const;
  void map_lines(KeyframeLoad& load, const KeyframeCounts& counts, const KeyframeGroup& group) const;
  void add_made(KeyframeLoad& load, const KeyframeCounts& counts, const SurfaceTable& surfaces, int contributors) const;
  void add_diced(wire::UnitCounts& units, const wire::MadeSurface& surface) const;
  void add_exchange(KeyframeLoad& load, const KeyframeCounts& counts, const SurfaceTable& surfaces,
                    const KeyframeGroup& group) const;
  Machines machines_of(const KeyframeGroup& group) const;
  int nodes_on_a_computer(int nodes) const;
  double pixel_bytes() const { return static_cast<double>(wire::pixel_bytes(setting_.pixels())); }
  double line_bytes() const { return setting_.film.settings().width * pixel_bytes(); }
  double height() const { return setting_.film.settings().height; }

  const Setting setting_;
  const Costs costs_;
  const farm::NodeMemory memory_;  // of a node
  const std::uint32_t band_lines_;
  const std::size_t lights_;
};

}  // namespace mars::forecast
