// The kinds of work that nodes and the host count as they go (messages::charge). What a unit costs is a platform's
// (host/experiments/platform.h); only simulated machines ask.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace mars::wire {

enum class Work : int {
  // Of a node.
  first_frame,      // of a node: code and buffers are not in its caches yet
  fresh_byte,       // of frames' memory, used for the first time
  frame,            // begun
  segment,          // placed, in a frame, or a bone of its skin
  patch,            // diced
  meshlet,          // placed
  vertex,           // of patches
  mesh_vertex,      // of meshlets
  net_term,         // of the means that points of nets' patches are
  skin_weight,      // of meshlets' vertices: a bone, blended by matrices
  dual_weight,      // by dual quaternions
  triangle_tested,  // of patches and meshlets
  row_tested,       // triangles tested, times a pixel's samples
  triangle,         // set up: it touches a sample
  edge_box_made,    // edge boxes of triangles set up
  vertex_light,     // for each vertex, or flat triangle, that is shaded
  edge_box_filled,  // put into its line
  line_mapped,      // to its home
  line,             // drawn
  edge_box,         // drawn on its line
  sample,           // that these cover
  shaded,           // samples, or groups of a pixel's that show the same triangle
  light,            // for each of them
  facet_light,      // lights times samples of rough surfaces
  pixel,            // sent
  still_byte,       // kept for inbetweens, or taken from what is kept
  casting_light,    // for each group of samples, where lights cast: its light is kept apart, and summed later
  shadow_point,     // put on a grid of a light's view
  caster,           // patch or meshlet diced that may cast a shadow on such points
  diced_vertex,     // of casters
  caster_vertex,    // put on a grid
  caster_triangle,  // set up on a grid
  // Of the host.
  host_strip,     // that the host takes
  host_run,       // of pixels
  host_byte,      // of pixels that it pastes
  host_restored,  // bytes of the background
  host_frame,     // that it begins and finishes
  // Of whoever makes frames' files: the host's sinks, or nodes.
  file,                // made
  encoded_byte,        // of pixels, hashed and encoded for PNG files
  encoded_png16_byte,  // for PNG files of 16 bits
  encoded_exr_byte,    // for EXR files
  file_byte,           // written
};

// As platform files name them.
inline constexpr std::array<std::string_view, 42> kWorkNames{
    "first_frame",      "fresh_byte",      "frame",        "segment",      "patch",
    "meshlet",          "vertex",          "mesh_vertex",  "net_term",     "skin_weight",
    "dual_weight",      "triangle_tested", "row_tested",   "triangle",     "edge_box_made",
    "vertex_light",     "edge_box_filled", "line_mapped",  "line",         "edge_box",
    "sample",           "shaded",          "light",        "facet_light",  "pixel",
    "still_byte",       "casting_light",   "shadow_point", "caster",       "diced_vertex",
    "caster_vertex",    "caster_triangle", "host_strip",   "host_run",     "host_byte",
    "host_restored",    "host_frame",      "file",         "encoded_byte", "encoded_png16_byte",
    "encoded_exr_byte", "file_byte",
};

// Units by kind: those of a node come first, then those of the host and of files.
inline constexpr std::size_t kNodeKinds = static_cast<std::size_t>(Work::host_strip);
inline constexpr std::size_t kHostKinds = kWorkNames.size() - kNodeKinds;
using NodeUnits = std::array<std::uint64_t, kNodeKinds>;
using HostUnits = std::array<std::uint64_t, kHostKinds>;

}  // namespace mars::wire
