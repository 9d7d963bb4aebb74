// One node's way through the frames of an interval: the keyframe together with the other nodes of its group
// (thesis 4.8, four steps), inbetweens alone (4.9). All buffers are made when the film is loaded.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "node/raster/arena.h"
#include "node/raster/czb.h"
#include "node/group/exchange.h"
#include "node/group/outbox.h"
#include "node/polygons.h"
#include "node/raster/scanline.h"
#include "node/geometry/scene.h"
#include "node/tracer.h"

namespace mars::node {

// Where PhaseTimes has each step, by Phase.
inline constexpr std::array kPhaseTimes{&PhaseTimes::dice,     &PhaseTimes::sum,  &PhaseTimes::map,
                                        &PhaseTimes::exchange, &PhaseTimes::fill, &PhaseTimes::scanline,
                                        &PhaseTimes::depth,    &PhaseTimes::credit};

class Renderer {
 public:
  // `machines`: each node's. Collective over a machine's nodes.
  Renderer(const FilmView& film, const Load& load, std::span<const std::int32_t> machines, const Kernels& kernels);

  // Draws the caller's share of `frames` (see Render) and sends it.
  void render(const Render& command, std::span<const std::uint32_t> frames);

  // Sends what was recorded so far, where the run is traced.
  void send_trace();
  // When there are no more frames: waits until what was sent is gone.
  void finish();

  Outbox& outbox() { return outbox_; }
  // The frame at hand, for a fault's report.
  std::uint32_t frame() const { return frame_; }

 private:
  void draw_frame(FrameKind kind, const hal::Group& group);
  Polygons make_polygons(const hal::Group& group);
  void sum_counts(const hal::Group& group);
  std::uint32_t plan_passes(const hal::Group& group);
  std::uint64_t memory_for(const hal::Group& group, std::uint32_t passes) const;
  void draw_pass(const hal::Group& group, const Polygons& own, std::uint32_t pass, std::uint32_t passes);
  std::uint32_t draw_strip(const LineBoxes& boxes, std::uint32_t first, const Shading& look, StripBuffer& out);
  // Waits until what was sent to nodes is gone; after the last pass of a keyframe nodes give each other CZB.
  void finish_pass(const hal::Group& group, bool last);
  void send_strip(const LineRange& lines, bool last);
  void mark_lines(const hal::Group& group, std::uint32_t pass, std::uint32_t passes);
  LineBoxes gather_boxes(const hal::Group& group, const Polygons& own, const LineRange& lines,
                         std::span<const LineRange> homes);
  Shading shading(const Triangle* triangles) const;
  // Adds the time since the last call to `phase`.
  void clock(Phase phase);

  std::optional<Tracer> tracer_;
  Scene scene_;
  const Kernels& kernels_;
  Mapping mapping_;
  PolygonMaker polygon_maker_;
  Arena arena_;
  ZBuffer z_buffer_;
  Czb czb_;
  Exchange exchange_;
  Outbox outbox_;

  std::uint32_t frame_ = 0;
  Render command_{};
  LineRange lines_of_movers_;               // in the interval's inbetweens
  std::vector<std::uint8_t> draws_;         // which of the group's nodes draw inbetweens of the interval
  std::vector<std::uint32_t> line_counts_;  // edge boxes of own triangles
  std::vector<double> sums_, work_;         // EBC as it is summed, then each node's memory for its own triangles
  std::vector<std::uint64_t> ebc_;          // prefix-summed over all nodes
  std::vector<LineRange> homes_;
  std::vector<LineRange> pass_homes_;
  std::vector<std::uint8_t> wanted_lines_;
  struct {
    std::uint64_t triangles;
    std::uint64_t edge_boxes;
    bool all_stored;
  } made_{};  // by make_polygons
  Strip strip_{};  // of the frame at hand
  std::uint64_t sent_before_ = 0;
  double clock_ = 0;
};

}  // namespace mars::node
