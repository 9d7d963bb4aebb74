// What a frame has to be drawn, counted without drawing it (node/frame_counter.h): what the host forecasts a rendering
// from.
#pragma once

#include <cstdint>
#include <vector>

#include "node/wire/protocol.h"

namespace mars::wire {

// Patches and meshlets of a frame are counted in so many shares, by their number modulo it: a node of a group of 1, 2,
// 4 ... makes the triangles of whole shares.
inline constexpr std::uint32_t kCountedShares = 64;

// Of one share.
struct ShareCounts {
  double patches = 0;
  double vertices = 0;
  double triangles_tested = 0;
  double triangles = 0;  // that touch a sample
  double edge_boxes = 0;
};

// Of one line of pixels. What is seen of it is decided on some lines and estimated from these on the others.
struct LineCounts {
  double edge_boxes = 0;
  double samples = 0;            // that these cover
  double moving_edge_boxes = 0;  // of these, moving parts'
  double moving_samples = 0;
  double constant_pixels = 0;  // that show stationary parts (CFB)
  double moving_pixels = 0;    // that show moving ones (MFB)
  double constant_runs = 0;    // of neighbouring pixels
  double moving_runs = 0;
  double constant_groups = 0;  // that are shaded: of a pixel's samples those that show the same triangle
  double moving_groups = 0;
};

struct FrameCounts {
  FrameKind kind = FrameKind::keyframe;
  std::uint32_t frame = 0;
  std::vector<ShareCounts> shares;     // kCountedShares; an inbetween's of moving parts only, as its lines
  std::vector<LineCounts> lines;       // of the picture
  std::uint32_t first_still_line = 0;  // of those that inbetweens may touch (keyframes)
  std::uint32_t last_still_line = 0;
};

}  // namespace mars::wire
