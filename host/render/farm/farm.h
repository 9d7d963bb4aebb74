// The host's side of a rendering: boots the nodes, sends the film, gives units to groups of nodes, composes
// their strips to frames, hands these to the sinks and gives credit back when they were taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/render/sinks/sink_pool.h"
#include "host/render/trace/trace.h"
#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::host {

// A node cannot go on.
class NodeFailure : public Failure {
 public:
  // `frame` -1: before any.
  NodeFailure(const std::string& reason, int node, int frame);

  int node;
  int frame;
};

struct FarmOptions {
  node::Mapping mapping = node::Mapping::greedy;
  bool coherence = true;
  std::uint32_t groups = 0;            // that work at a time; 0: as many as pay
  std::vector<std::uint32_t> frames;  // ascending, within the film, at least one
  std::uint64_t memory = 0;           // bytes for a frame on a node; 0: as the node with the least offers
  bool each_frame = false;            // report what is known of each frame, which grows with the film
  Trace* trace = nullptr;             // to be filled; none: nothing is recorded
};

struct FinishedFrame {
  std::uint32_t number;
  std::uint32_t interval;
  node::FrameKind kind;
  double seconds;  // since the first command, when its last strip had come and it was composed
  double given = 0;  // likewise, when its unit was given to a group
};

// Called from the thread that runs the farm.
struct FarmListener {
  // All nodes are there; keyframes and inbetweens are what will be drawn.
  std::function<void(std::span<const node::Hello>, std::uint32_t keyframes, std::uint32_t inbetweens)> booted;
  std::function<void(const FinishedFrame&)> finished;  // the sinks have it
  // If there is one, units are given to the first group alone, one at a time: it is asked when the sinks have all
  // frames given before, and may wait. False: no more frames are wanted.
  std::function<bool()> more;
};

struct FarmReport {
  std::vector<node::Hello> nodes;
  // Where each frame's were asked for: the last strip of each node, with all its counts, as they came.
  std::vector<node::Strip> strips;
  std::vector<FinishedFrame> frames;
  std::uint64_t film_bytes = 0;
  double load_seconds = 0;    // from the last node's Hello until all have the film
  double render_seconds = 0;  // from the first command until the last frame was composed
  double total_seconds = 0;   // until the sinks had taken it
};

// The calling HAL process is the host. Throws Failure when a node or a sink fails; the nodes are then still
// waiting, for whoever ends the run.
FarmReport render_film(std::span<const std::byte> film_block, const FarmOptions& options, SinkPool& sinks,
                       const FarmListener& listener);

// The pixel (protocol.h) of a colour 0..1.
std::uint32_t pixel_of(const std::array<float, 3>& color);

}  // namespace mars::host
