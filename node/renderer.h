// How a node draws a picture of a view: a keyframe together with the other nodes of its group (thesis 4.8, four steps),
// an inbetween alone (4.9), or its own lines of one. What views share is here: a frame's memory, and strips on their
// way to the host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/collectives/group.h"
#include "node/file_output.h"
#include "node/frame_report.h"
#include "node/group/frame_memory.h"
#include "node/group/outbox.h"
#include "node/group/passes.h"
#include "node/heartbeat.h"
#include "node/phase_scope.h"
#include "node/raster/neighbours.h"
#include "node/tessellator.h"
#include "node/tracer.h"
#include "node/canvas.h"
#include "node/wire/protocol.h"

namespace mars::node {

// An inbetween that several nodes draw, each its lines.
struct Sharing {
  collectives::Group team{0, 1};  // one node draws all of it
  int writer = 0;                 // of the team, where nodes write files

  bool is_shared() const { return team.count > 1; }
};

// Of a view's picture: of a film, a frame and its interval; else the picture's number and its view's.
struct Frame {
  wire::FrameKind kind;
  std::uint32_t number;
  std::uint32_t interval;
  collectives::Group group;                     // that draws it
  std::int32_t contributors;                    // of it, the first; the others take part in what all do together
  bool is_written = false;                      // into a file, by these nodes; else it goes to the host
  Sharing sharing{};                            // of an inbetween
  const geometry::ShapeBoxes* boxes = nullptr;  // of a film's shapes
};

class Renderer {
 public:
  // Whether what is being drawn is wanted no more.
  using HasEnded = std::function<bool()>;

  // `machines`: each node's machine, as in Load. `heartbeat` outlives it. Collective over a machine's nodes.
  // `writer` may be nullptr: then all frames go to the host.
  Renderer(const wire::Load& load, std::span<const std::int32_t> machines, simd::InstructionSet set,
           Heartbeat& heartbeat, wire::FrameWriter* writer = nullptr);

  // Draws the caller's share of the view's scene as it is now, and sends it; once it `has_ended`, sends no more of it
  // but its last strip. Collective over the frame's group.
  void draw(Canvas& canvas, const Frame& frame, const HasEnded& has_ended = {});

  // The caller draws inbetweens with these nodes from now on.
  void join(const collectives::Group& team);

  const raster::Neighbours& neighbours() const { return neighbours_; }

  // Sends what was recorded so far, where the run is traced.
  void send_trace();
  // Of a node that writes files: what has become of them goes to the host.
  void report_files() { file_output_->report(); }
  // When there are no more frames: waits until what was sent is gone.
  void finish();

  group::Outbox& outbox() { return outbox_; }
  // Why the machine's nodes do not read each other's triangles; "" where they do, or where there is one.
  const std::string& refusal() const { return memory_.refusal(); }
  // The current frame, for a fault's report.
  std::uint32_t frame() const { return report_.strip().frame; }

 private:
  void begin(Canvas& canvas, const Frame& frame, const HasEnded& has_ended);
  // The caller's lines of a shared inbetween; else all.
  geometry::LineRange share_lines();
  Tessellation tessellate_all();
  Tessellation tessellate_part(const group::Pass& pass);
  Tessellation tessellate();
  std::span<const std::uint8_t> unkept_lines();
  // Whether own triangles are all there and can be put into their lines. Else several passes follow, or a Failure where
  // a line has more than can be counted.
  bool can_fill(const Tessellation& own) const;
  // Puts own edge boxes into their lines, where other nodes may read them.
  void fill_own_lines(const raster::Polygons& own);
  // Of EBC and what each mapping weighs lines by, over the group.
  void sum_up(const group::MadeCounts& made);
  std::span<const std::uint64_t> foreseen_still_bytes();
  // Returns the number of passes.
  std::uint32_t map_to_homes(const group::MadeCounts& made);
  // Whether the group's nodes make triangles of other machines again, instead of sending them; the same on all.
  bool makes_again() const;
  // Sets parts_; returns the lines to be drawn.
  geometry::LineRange exchange_triangles(const raster::Polygons& own, const group::Pass& pass);
  void send_triangles(const raster::Polygons& own, std::span<const geometry::LineRange> homes_now);
  raster::LineFiller await_triangles(const geometry::LineRange& lines);
  void receive_triangles(const geometry::LineRange& lines);
  void make_triangles_again(const geometry::LineRange& lines);
  Tessellation tessellate_others(const geometry::LineRange& lines);
  raster::Polygons receive_some(group::AwaitedTriangles& awaited);
  void draw_lines(const geometry::LineRange& lines, const group::Pass& pass);
  raster::StripBuffer& begin_strip(bool constant);
  // Draws `lines` from the first on until the strip is full, all are drawn or the view has ended; one past the last of
  // them.
  std::uint32_t draw_strip(const geometry::LineRange& lines, const shading::Shading& shading, raster::StripBuffer& out);
  std::uint32_t draw_until_full(const geometry::LineRange& lines, const shading::Shading& shading,
                                raster::StripBuffer& out);
  // `some`, which are prepared where there are shadows.
  void draw_some(const geometry::LineRange& some, const shading::Shading& shading, raster::StripBuffer& out);
  // Prepares lines from the first of `lines` on, as many as there is memory for: what is seen, and what casters block.
  void prepare_shadows(const geometry::LineRange& lines, const shading::Shading& shading);
  void charge_seen(const geometry::LineRange& lines, const raster::DrawnCounts& counts);
  shadow::Picture picture(const shading::Shading& shading) const;
  int frame_writer() const;
  void begin_writing();
  void paste_strip(const geometry::LineRange& lines);
  void finish_writing();
  bool exchange_team_bands();
  void exchange_bands(const group::BandNeeds& needs);
  // Waits until what was sent to nodes is gone; after the last pass of a keyframe nodes give each other CZB.
  void finish_exchange(const group::Pass& pass);
  void finish_triangles();
  void send_strip(const geometry::LineRange& lines, bool last);
  // EBC of each; none where nobody watches.
  std::span<const std::uint32_t> watched_edge_boxes(const geometry::LineRange& lines);

  PhaseScope phase(wire::Phase phase) { return {phase, heartbeat_, report_}; }
  geometry::Scene& scene() const { return canvas_->scene; }
  bool has_ended() const { return *has_ended_ && (*has_ended_)(); }
  std::size_t member() const;  // the caller's index in the group
  std::size_t group_size() const;
  bool contributes() const { return member() < contributors_; }
  std::span<geometry::LineRange> homes() { return std::span(homes_).first(static_cast<std::size_t>(group_.count)); }
  bool triangles_travel() const;  // to nodes of the group that cannot read the caller's memory
  shading::Shading shading() const;

  Heartbeat& heartbeat_;
  std::optional<Tracer> tracer_;
  wire::Mapping mapping_;
  wire::Exchange exchange_;
  wire::PixelFormat pixel_format_;
  Tessellator tessellator_;
  raster::Neighbours neighbours_;
  group::FrameMemory memory_;
  group::Outbox outbox_;

  std::optional<FileOutput> file_output_;  // none: all frames go to the host

  bool is_first_ = true;       // of all frames
  std::size_t keyframes_ = 0;  // so far

  // Of the current frame.
  Canvas* canvas_ = nullptr;  // that it is of
  const HasEnded* has_ended_ = nullptr;
  FileOutput* file_ = nullptr;    // none: it goes to the host
  collectives::Group group_;      // that draws it
  std::size_t contributors_ = 1;  // of it
  Sharing sharing_;               // of it
  const geometry::ShapeBoxes* boxes_ = nullptr;
  geometry::LineRange own_lines_{0, 0};   // share_lines()
  std::vector<raster::LineBoxes> parts_;  // edge boxes of the lines to be drawn; own ones first
  geometry::LineRange prepared_{0, 0};    // lines whose shadows are known
  std::vector<geometry::LineRange> homes_;
  std::vector<geometry::LineRange> pass_homes_;
  std::vector<std::uint8_t> others_;  // 1: a node of the group whose memory the caller cannot read
  const bool is_watched_;
  std::vector<std::uint32_t> watched_;  // watched_edge_boxes'
  FrameReport report_;
};

}  // namespace mars::node
