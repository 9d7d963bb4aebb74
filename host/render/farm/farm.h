// The host's side of a rendering: has the engine draw a film on all nodes. The buffers that there are decide how many
// frames are under way: a strip whose frame has no buffer waits in its slot, and a node never has more strips in the
// host's memory than it has credits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/render/farm/engine.h"
#include "host/render/farm/node_memory.h"
#include "host/render/farm/node_rates.h"
#include "host/render/farm/plan.h"
#include "host/render/farm/writers.h"
#include "host/render/sinks/sink_pool.h"
#include "host/render/watch/watch.h"
#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::farm {

// Pictures are those of the sinks.
struct FarmOptions : EngineOptions {
  wire::Mapping mapping = wire::Mapping::cost;
  wire::Exchange exchange = wire::Exchange::send;
  std::uint64_t memory = 0;          // bytes on a node; 0: as the node with the least offers
  AskedMemory asked_memory;          // of parts of it
  bool each_frame = false;           // report what is known of each frame, which grows with the film
  bool adapts = false;               // slow nodes get fewer inbetweens; long tasks are given in portions
  watch::Watch* watch = nullptr;     // none: nobody watches; it ends before the film does
  const Writing* writing = nullptr;  // none: the host composes all frames for the sinks
};

struct FinishedFrame {
  std::uint32_t number;
  std::uint32_t interval;
  wire::FrameKind kind;
  double seconds;               // since the first command, when its last strip had come and it was composed
  double given = 0;             // seconds, when its task was given to a group
  std::int32_t first_node = 0;  // the first of `nodes` that drew it
  std::int32_t nodes = 0;
};

// Called from the thread that runs the farm.
struct FarmListener {
  // All nodes are there; keyframes and inbetweens are what will be drawn.
  std::function<void(std::span<const wire::Hello>, std::uint32_t keyframes, std::uint32_t inbetweens)> booted;
  std::function<void(const std::string& text)> warned;
  // How many times as long as others the node takes from now on; 1: it is as fast again.
  std::function<void(int node, double slowness)> slowed;
  std::function<void(const FinishedFrame&)> finished;  // the sinks have it
  // If there is one, tasks are given to the first group alone, one at a time: it is asked when the sinks have all
  // frames given before, and may wait. False: no more frames are wanted.
  std::function<bool()> more;
};

struct FarmReport {
  std::vector<wire::Hello> nodes;
  std::vector<collectives::Group> groups;
  // Where each frame's were asked for: the last strip of each node, with all its counts, as they came.
  std::vector<wire::Strip> strips;
  std::vector<FinishedFrame> frames;
  std::uint64_t film_bytes = 0;
  NodeMemory node_memory;
  double load_seconds = 0;           // from the last node's Hello until all have the film
  double render_seconds = 0;         // from the first command until the last frame was composed
  double total_seconds = 0;          // until the sinks had taken it
  double busy_seconds = 0;           // of those, in which the host took and composed strips
  double sink_seconds = 0;           // of all threads that hand frames to the sink
  wire::HostUnits charged{};         // what the host did, by kind
  images::FileWork files;            // that the host wrote
  std::uint32_t sinks = 0;           // threads that did
  double storing_seconds = 0;        // in which at least one file was being written, on nodes too
  std::uint64_t node_files = 0;      // that nodes wrote
  std::vector<SlowTime> slow_times;  // since the first command; of runs that adapt
  bool cancelled = false;            // before all frames were composed
};

// What belongs to one rendering.
struct FilmRun {
  const wire::PackedFilm& film;
  const Plan& plan;
  const FarmOptions& options;
  sinks::SinkPool& sinks;
  const FarmListener& listener;
  Engine& engine;
  FarmReport& report;  // to be filled
};

// The calling HAL process is the host. When all frames are with the sinks, or when it is cancelled, Stop has been sent
// to all nodes. Throws Failure when a node or a sink fails; the nodes are then still waiting, and the caller must end
// the run.
FarmReport render_film(std::span<const std::byte> film_block, const Plan& plan, const FarmOptions& options,
                       sinks::SinkPool& sinks, const FarmListener& listener);

// Where there is nothing to draw: once all nodes are there, they are stopped without a film.
void dismiss_nodes();

}  // namespace mars::farm
