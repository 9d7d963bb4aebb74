// One node's way through the frames of an interval: the keyframe together with the other nodes of its group
// (thesis 4.8, four steps), inbetweens alone (4.9). All buffers are made when the film is loaded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/collectives/group.h"
#include "node/frame_report.h"
#include "node/geometry/scene.h"
#include "node/group/still_exchange.h"
#include "node/group/exchange.h"
#include "node/group/frame_memory.h"
#include "node/group/group_sums.h"
#include "node/group/outbox.h"
#include "node/group/passes.h"
#include "node/heartbeat.h"
#include "node/raster/neighbours.h"
#include "node/raster/scanline.h"
#include "node/raster/still_lines.h"
#include "node/tessellator.h"
#include "node/tracer.h"
#include "node/wire/commands.h"

namespace mars::node {

class Renderer {
 public:
  // `machines`: each node's machine, as in Load. The film's block and `heartbeat` outlive it. Collective over a
  // machine's nodes.
  Renderer(const wire::FilmView& film, const wire::Load& load, std::span<const std::int32_t> machines,
           simd::InstructionSet set, Heartbeat& heartbeat);

  // Draws the caller's share of the frames (see Render) and sends it.
  void render(const wire::RenderCommand& command);

  // Sends what was recorded so far, where the run is traced.
  void send_trace();
  // When there are no more frames: waits until what was sent is gone.
  void finish();

  group::Outbox& outbox() { return outbox_; }
  // Why the machine's nodes do not read each other's triangles; "" where they do, or where there is one.
  const std::string& refusal() const { return memory_.refusal(); }
  // The current frame, for a fault's report.
  std::uint32_t frame() const { return report_.strip().frame; }

 private:
  void begin_interval(const wire::RenderCommand& command);
  void draw_inbetweens(const wire::RenderCommand& command);
  // By the first `contributors` nodes of the group; the others take part in what all do together.
  void draw_frame(wire::FrameKind kind, std::uint32_t interval, std::uint32_t frame, const collectives::Group& group,
                  std::int32_t contributors);

  Tessellation tessellate_all();
  Tessellation tessellate_part(const group::Pass& pass);
  Tessellation tessellate();
  // What was done, for machines that are simulated (wire/work.h).
  void charge_tessellation(const Tessellation& own);
  void charge_strip(const geometry::LineRange& lines, const raster::StripBuffer& strip);
  void charge_file();
  std::span<const std::uint8_t> unkept_lines();
  // Whether own triangles are all there and can be put into their lines. Else several passes follow, or a Failure where
  // a line has more than can be counted.
  bool can_fill(const Tessellation& own) const;
  // Puts own edge boxes into their lines, where other nodes may read them.
  void fill_own_lines(const raster::Polygons& own);
  // Returns the number of passes.
  std::uint32_t map_to_homes(const group::MadeCounts& made);
  // Sets parts_; returns the lines to be drawn.
  geometry::LineRange exchange_triangles(const raster::Polygons& own, const group::Pass& pass);
  void receive_triangles(const geometry::LineRange& lines);
  void draw_lines(const geometry::LineRange& lines, const group::Pass& pass);
  // Draws `lines` from the first on until the strip is full or all are drawn; one past the last of them.
  std::uint32_t draw_strip(const geometry::LineRange& lines, const shading::Shading& shading, raster::StripBuffer& out);
  // Waits until what was sent to nodes is gone; after the last pass of a keyframe nodes give each other CZB.
  void finish_exchange(const group::Pass& pass);
  void send_strip(const geometry::LineRange& lines, bool last);
  // EBC of each; none where nobody watches.
  std::span<const std::uint32_t> watched_edge_boxes(const geometry::LineRange& lines);

  std::size_t member() const;  // the caller's index in the group
  std::size_t group_size() const;
  bool contributes() const { return member() < contributors_; }
  std::span<geometry::LineRange> homes() { return std::span(homes_).first(static_cast<std::size_t>(group_.count)); }
  bool triangles_travel() const;  // to nodes of the group that cannot read the caller's memory
  shading::Shading shading() const;

  Heartbeat& heartbeat_;
  std::optional<Tracer> tracer_;
  geometry::Scene scene_;
  wire::Mapping mapping_;
  wire::PixelFormat pixel_format_;
  Tessellator tessellator_;
  raster::ZBuffer z_buffer_;
  raster::Neighbours neighbours_;
  raster::StillLines still_;
  group::FrameMemory memory_;
  group::GroupSums sums_;
  group::TriangleExchange triangle_exchange_;
  group::StillExchange still_exchange_;
  group::Outbox outbox_;

  // Of the current interval.
  std::vector<std::uint8_t> contributes_;  // 1: the node draws inbetweens; by nodes of the group

  bool is_first_ = true;  // of all frames

  // Of the current frame.
  collectives::Group group_;                      // that draws it
  std::size_t contributors_ = 1;                  // of it
  std::vector<raster::LineLoad> line_loads_;      // of own triangles
  std::vector<std::uint64_t> line_totals_;        // of their edge boxes, before each line and at the end
  std::vector<std::uint64_t> awaited_;            // edge boxes of other nodes that are to come, of each line
  std::vector<raster::LineBoxes> parts_;          // edge boxes of the lines to be drawn; own ones first
  std::vector<std::uint8_t> wanted_lines_;        // in the current pass
  std::vector<std::uint8_t> wanted_still_lines_;  // likewise, of stationary parts in an inbetween
  std::vector<geometry::LineRange> homes_;
  std::vector<geometry::LineRange> pass_homes_;
  std::vector<std::uint32_t> watched_;  // watched_edge_boxes'; empty: nobody watches
  FrameReport report_;
};

}  // namespace mars::node
