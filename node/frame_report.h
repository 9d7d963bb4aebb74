// A node's report to the host about the current frame: the header of its strips, with times and counts so far.
#pragma once

#include <array>
#include <cstdint>

#include "node/geometry/line_range.h"
#include "node/wire/protocol.h"

namespace mars::node {

// Where PhaseTimes has each step, by Phase.
inline constexpr std::array kPhaseTimes{
    &wire::PhaseTimes::dice,   &wire::PhaseTimes::sum,      &wire::PhaseTimes::map,    &wire::PhaseTimes::exchange,
    &wire::PhaseTimes::fill,   &wire::PhaseTimes::scanline, &wire::PhaseTimes::shadow, &wire::PhaseTimes::depth,
    &wire::PhaseTimes::credit, &wire::PhaseTimes::compose,  &wire::PhaseTimes::bands,  &wire::PhaseTimes::storage};

class FrameReport {
 public:
  // A new frame. Its clock starts.
  void begin(wire::FrameKind kind, std::uint32_t frame, std::uint32_t interval);
  // The node did `units` of a kind of work, in the phase that is clocked next.
  void charge(wire::Work kind, std::uint64_t units);
  // Adds the time since the last call to `phase`, and records it as a span.
  void clock(wire::Phase phase);
  // Leaves the time since the last call out: it belongs to no phase.
  void skip_clock();
  // The frame had `bytes` bytes in use.
  void note_memory(std::uint64_t bytes);
  // Lines of the frame are left out.
  void cut() { is_cut_ = true; }
  bool is_cut() const { return is_cut_; }
  // Prepares the header of the frame's next strip.
  void set_strip(const geometry::LineRange& lines, bool last);
  // Records the frame as a span.
  void end() const;

  wire::Strip& strip() { return strip_; }
  const wire::Strip& strip() const { return strip_; }
  bool is_keyframe() const { return strip_.kind == wire::FrameKind::keyframe; }

 private:
  wire::Strip strip_{};
  std::uint64_t sent_before_ = 0;  // bytes to nodes
  bool is_cut_ = false;
  double begin_ = 0;
  double clock_ = 0;
};

}  // namespace mars::node
