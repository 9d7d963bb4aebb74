// What the host reports while it renders: one JSON object a line on its standard output, read by `mars render` and by
// programs that supervise a run. Its key "event" names the event: loading, warning, loaded, resumed, booted, progress,
// frame, beat, drawing, fault or done; readers pass over events they do not know. Seconds count from the first command
// to the nodes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host/render/events/progress.h"

namespace mars::events {

// The host reads and compiles the film, which takes long for a long one, and claims its frames in the folder, where it
// may wait for other runs. Nodes wait meanwhile.
struct Loading {
  std::string film;  // its file, as the person gave it

  bool operator==(const Loading&) const = default;
};

// That is done; now the host waits for its nodes.
struct Loaded {
  double seconds = 0;  // of reading and compiling
  std::string run{};   // the name under which it has its claim in the folder; "": it has none

  bool operator==(const Loaded&) const = default;
};

// A probable mistake in the film, which is rendered nevertheless.
struct Warning {
  std::string text;

  bool operator==(const Warning&) const = default;
};

// The folder has frames of this film already; only the others are rendered.
struct Resumed {
  std::uint32_t there = 0;  // of those asked for
  std::uint32_t of = 0;
  std::string changed;  // which frames are rendered again since the film was edited, as a line; "": it was not

  bool operator==(const Resumed&) const = default;
};

// All nodes are there.
struct Booted {
  struct Node {
    std::int32_t node = 0;
    std::string host;
    std::int32_t rank = 0;  // its number for what started it (MPI's)
    std::string binding;    // "" if free
    std::string simd;

    bool operator==(const Node&) const = default;
  };

  std::string backend;  // mpi or threads
  std::uint32_t machines = 0;
  std::vector<Node> nodes;

  bool operator==(const Booted&) const = default;
};

// A frame is where it belongs.
struct FrameTaken {
  std::uint32_t number = 0;
  std::uint32_t interval = 0;
  FrameKind kind = FrameKind::keyframe;

  bool operator==(const FrameTaken&) const = default;
};

// Every two seconds at least, from the start on: the host lives, whatever it waits for.
struct Beat {
  // A node from which the host has heard nothing for some seconds.
  struct Node {
    std::int32_t node = 0;
    std::string host;
    std::int32_t frame = -1;  // -1: none
    std::string doing;        // its phase, as it said last: "scanline"
    double silent = 0;        // seconds

    bool operator==(const Node&) const = default;
  };

  std::string doing;  // the host: "loading", "waiting for nodes", "rendering", "waiting for storage", "ending"
  std::vector<Node> silent;

  bool operator==(const Beat&) const = default;
};

// The host was asked to end before its last frame: the frame that each node was drawing then.
struct Drawing {
  struct Node {
    std::int32_t node = 0;
    std::int32_t frame = 0;

    bool operator==(const Node&) const = default;
  };

  std::vector<Node> nodes;  // those that were drawing

  bool operator==(const Drawing&) const = default;
};

// The run fails, and why.
struct Fault {
  std::string problem;
  std::string where;                  // file and element, node and frame; or ""
  std::string remedy;                 // or ""
  std::optional<std::int32_t> node;   // that failed; none: the host
  std::optional<std::int32_t> frame;  // it was drawing
  std::string replay;                 // a command that does it again, or ""
  std::uint32_t lost = 0;             // frames that were rendered and are gone: another run renders them again

  bool operator==(const Fault&) const = default;
};

// All frames are where they belong.
struct Done {
  std::uint32_t frames = 0;
  double seconds = 0;
  std::string folder;             // "" without a sink
  std::uint64_t trace_lacks = 0;  // events left out of the trace

  bool operator==(const Done&) const = default;
};

using Event = std::variant<Loading, Warning, Loaded, Resumed, Booted, Progress, FrameTaken, Beat, Drawing, Fault, Done>;

// One line, with its end.
std::string line_of(const Event& event);

// None for a line that is no event, or one that this version does not know.
std::optional<Event> read_event(std::string_view line);

}  // namespace mars::events
