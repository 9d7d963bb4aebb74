// The kinds of work that nodes and the host count as they go (messages::charge). What a unit costs is a platform's
// (host/experiments/platform.h); only simulated machines ask.
#pragma once

#include <array>
#include <string_view>

namespace mars::wire {

enum class Work : int {
  frame,            // a node begins
  segment,          // placed, in a frame
  patch,            // diced, and meshlets placed
  vertex,           // of these
  triangle_tested,  // of these
  triangle,         // set up: it touches a sample
  edge_box_made,    // of these
  edge_box_filled,  // put into its line
  line_mapped,      // to its home
  edge_box,         // drawn on its line
  sample,           // that these cover
  pixel,            // shaded
  light,            // for each pixel shaded
  still_byte,       // kept for inbetweens
  host_strip,       // that the host takes
  host_byte,        // of pixels that it pastes
  host_frame,       // that it begins and finishes
  sink_frame,       // that a sink takes
  sink_byte,        // of these
  node_frame,       // that a node would write itself, were frames written by nodes
  node_frame_byte,  // of these
};

// As platform files name them.
inline constexpr std::array<std::string_view, 21> kWorkNames{
    "frame",           "segment",     "patch",      "vertex",     "triangle_tested", "triangle", "edge_box_made",
    "edge_box_filled", "line_mapped", "edge_box",   "sample",     "pixel",           "light",    "still_byte",
    "host_strip",      "host_byte",   "host_frame", "sink_frame", "sink_byte", "node_frame", "node_frame_byte"};

}  // namespace mars::wire
