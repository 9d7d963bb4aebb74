// What a rendering tells while it runs: one JSON object a line on the host program's standard output, read by
// `mars render`, and by anything else that wants to follow. Each object has a key "event" with the event's
// name and the fields below under their own names; readers skip events they do not know.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace mars::host {

// "booted": all nodes are there.
struct BootedEvent {
  struct Node {
    std::string host;     // name of its machine
    std::string binding;  // processors it is bound to, "" if free
    std::string simd;     // instruction set of its kernels
  };
  std::string backend;          // "mpi" or "threads"
  std::uint32_t machines = 0;
  std::vector<Node> nodes;
  std::uint32_t keyframes = 0;  // to be rendered
  std::uint32_t inbetweens = 0;
};

// "frame": a sink has taken it.
struct FrameEvent {
  std::uint32_t number = 0;
  std::uint32_t interval = 0;
  bool keyframe = false;  // else an inbetween
  double seconds = 0;     // since the first command to the nodes
};

// "fault": the run ends without all frames.
struct FaultEvent {
  std::string problem;
  std::string where;   // "node 3, frame 12", or a file; may be ""
  std::string remedy;  // may be ""
  std::string replay;  // the command that shows it again; may be ""
};

// "done": all frames are where they belong.
struct DoneEvent {
  std::uint32_t frames = 0;
  double seconds = 0;  // rendering, from the first command to the last frame taken
  std::string folder;  // "" where frames went nowhere
};

using Event = std::variant<BootedEvent, FrameEvent, FaultEvent, DoneEvent>;

// Writes the event's line and flushes.
void write_event(std::ostream& out, const Event& event);

// None where the line is no event, or one this program does not know.
std::optional<Event> read_event(std::string_view line);

}  // namespace mars::host
