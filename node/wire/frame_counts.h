// What a frame has to be drawn, counted without drawing it (node/frame_counter.h): what the host forecasts a rendering
// from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "node/wire/protocol.h"
#include "node/wire/work.h"

namespace mars::wire {

// Units of a node's work by kind.
struct UnitCounts {
  std::array<double, kNodeKinds> units{};

  double& operator[](Work kind) { return units[static_cast<std::size_t>(kind)]; }
  double operator[](Work kind) const { return units[static_cast<std::size_t>(kind)]; }
};

// Of stationary parts (CFB), or of moving ones (MFB), on one line of pixels.
struct SeenCounts {
  double pixels = 0;
  double runs = 0;          // of neighbouring pixels
  double shaded = 0;        // groups of a pixel's samples that show the same triangle
  double highlights = 0;    // samples lit by models of highlights
  double facets = 0;        // and of rough surfaces
  double block_pixels = 0;  // of the compositor's blocks on this line, where the pixels do not fill them
  double points = 0;        // of casting lights without size, which samples put on their grids
  double kept_groups = 0;   // of those shaded, in columns that are kept for inbetweens

  SeenCounts& operator+=(const SeenCounts& more) {
    pixels += more.pixels, runs += more.runs, shaded += more.shaded, highlights += more.highlights;
    facets += more.facets, block_pixels += more.block_pixels, points += more.points;
    kept_groups += more.kept_groups;
    return *this;
  }
  SeenCounts operator*(double part) const {
    return {pixels * part, runs * part,         shaded * part, highlights * part,
            facets * part, block_pixels * part, points * part, kept_groups * part};
  }
};

// What is seen is decided on some lines, and estimated from these on the others.
struct LineCounts {
  double edge_boxes = 0;
  double samples = 0;            // that these cover
  double moving_edge_boxes = 0;  // of the edge boxes, moving parts'
  double moving_samples = 0;
  double moving_width = 0;  // in pixels, from the first edge box of moving parts to the last
  SeenCounts constant;
  SeenCounts moving;
  double kept_width = 0;   // in pixels, of stationary parts for inbetweens (keyframes)
  double swept_width = 0;  // of it, what moving parts alone may change: all nodes know it before the keyframe
};

// Which nodes need not dice a caster for its shadows.
enum class DicedBy : std::uint8_t {
  none,
  camera,   // the one node that diced it as a surface that the camera sees
  shadows,  // all that need it, for they kept it in an earlier frame
};

// A patch or meshlet that may cast shadows on lines [first_line, last_line): a caster of each node that draws one of
// them. Nodes that draw one of [first_put, last_put) put it on grids.
struct CasterCounts {
  std::uint32_t first_line, last_line;
  std::uint32_t first_put, last_put;
  DicedBy diced_by;
  double vertices;
  double put_vertices;  // on grids
  double triangles;     // set up on grids
};

// The triangles of one patch or meshlet on a line.
struct SurfaceLine {
  std::uint32_t edge_boxes = 0;
  std::uint32_t begin = 0;  // triangles whose first edge box is here
  std::uint32_t go_on = 0;  // triangles with edge boxes before, and here or behind
};

// Bones bend those of nets and with skins, these by either blend.
enum class SurfaceKind : std::uint32_t { patch, net_patch, meshlet, skin_meshlet, dual_meshlet };
inline constexpr SurfaceKind kLastSurfaceKind = SurfaceKind::dual_meshlet;

constexpr bool is_meshlet(SurfaceKind kind) { return kind >= SurfaceKind::meshlet; }

// A patch or meshlet that nodes make triangles of, of which the camera may see some.
struct MadeSurface {
  std::uint32_t number = 0;  // of all patches and meshlets: of n nodes, node `number` modulo n makes it
  SurfaceKind kind = SurfaceKind::patch;
  std::uint32_t bent = 0;  // terms of means, or weights of vertices, by which bones bend it
  std::uint32_t vertices = 0;
  std::uint32_t triangles_tested = 0;
  std::uint32_t colored = 0;  // vertices and flat triangles that are shaded
  std::uint32_t triangles = 0;
  std::uint32_t edge_boxes = 0;
  std::uint32_t first_line = 0;  // with edge boxes
  std::uint32_t lines = 0;
};

// The side of the host's blocks of pixels, by default.
inline constexpr std::uint32_t kCountedBlock = 16;

// Neighbouring blocks of a row that have pixels of a frame.
struct BlockStretch {
  std::uint16_t row, first, last;  // columns of blocks [first, last)
  std::uint16_t filled;            // 1: pixels fill them; else they do not fill any
};

struct FrameCounts {
  FrameKind kind = FrameKind::keyframe;
  std::uint32_t frame = 0;
  UnitCounts made;                         // what triangles take; an inbetween's of moving parts only
  std::vector<MadeSurface> surfaces;       // of a keyframe
  std::vector<SurfaceLine> surface_lines;  // of one surface after the other
  // What the host's blocks show, row by row, where all lines were drawn.
  std::vector<BlockStretch> constant_blocks, moving_blocks;
  std::vector<LineCounts> lines;       // of the picture
  std::uint32_t first_still_line = 0;  // of those that inbetweens may touch (keyframes)
  std::uint32_t last_still_line = 0;
  std::vector<CasterCounts> casters;
  double kept_points = 0;  // of still parts, that an inbetween's moving casters may block
};

}  // namespace mars::wire
