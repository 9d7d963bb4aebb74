#include "node/frame_report.h"

#include <algorithm>
#include <cstddef>

#include "hal/messages/process.h"
#include "hal/messages/recorder.h"
#include "hal/nx/nx_messages.h"

namespace mars::node {

void FrameReport::begin(wire::FrameKind kind, std::uint32_t frame, std::uint32_t interval) {
  begin_ = clock_ = dclock();
  messages::record_frame(static_cast<std::int32_t>(frame));
  sent_before_ = messages::traffic().to_nodes.bytes;
  strip_ = {};
  is_cut_ = false;
  strip_.frame = frame;
  strip_.interval = interval;
  strip_.kind = kind;
  strip_.node = static_cast<std::int32_t>(mynode());
}

void FrameReport::charge(wire::Work kind, std::uint64_t units) {
  messages::charge(static_cast<int>(kind), units);
  strip_.work.charged[static_cast<std::size_t>(kind)] += units;
}

void FrameReport::clock(wire::Phase phase) {
  const double now = dclock();
  strip_.times.*kPhaseTimes[static_cast<std::size_t>(phase)] += now - clock_;
  messages::record_span(static_cast<int>(phase), clock_, now);
  clock_ = now;
}

void FrameReport::skip_clock() { clock_ = dclock(); }

void FrameReport::note_memory(std::uint64_t bytes) { strip_.work.memory = std::max(strip_.work.memory, bytes); }

void FrameReport::set_strip(const geometry::LineRange& lines, bool last) {
  strip_.last = last ? 1 : 0;
  strip_.cut = last && is_cut_ ? 1 : 0;
  strip_.first_line = lines.first;
  strip_.last_line = lines.last;
  strip_.work.bytes_to_nodes = messages::traffic().to_nodes.bytes - sent_before_;
}

void FrameReport::end() const {
  const wire::Phase whole = is_keyframe() ? wire::Phase::keyframe : wire::Phase::inbetween;
  messages::record_span(static_cast<int>(whole), begin_, clock_, strip_.interval);
}

}  // namespace mars::node
