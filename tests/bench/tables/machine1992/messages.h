// The messages of the 1992 program. Nodes send the host whole pixels, not runs of what was drawn.
#pragma once

#include <cstddef>
#include <cstdint>

#include "node/geometry/triangle.h"

namespace mars::machine1992 {

// Message types. There is no receive by source: a sender is packed into the type.
inline constexpr long kEdgeBoxes = 1000;  // + the sender's number; an array of SentBox

// Strips go to the host as long messages do on the iPSC/2, in three steps: a node says that it has one, and waits; the
// host says when it is ready, and the strip comes.
inline constexpr long kKeyframe = 1;        // a node has a strip of a keyframe
inline constexpr long kInbetween = 100000;  // + the frame's number: of an inbetween
inline constexpr long kReady = 2;
inline constexpr long kStrip = 3;

// To all nodes: the keyframe is shown, inbetweens may begin.
inline constexpr long kGoOn = 4;

// An edge box with what is interpolated along it.
struct SentBox {
  geometry::Triangle triangle;
  std::uint16_t line;
  std::uint16_t first;  // columns [first, last)
  std::uint16_t last;
  std::uint16_t moving;
};

// In a message without the bytes that align it.
inline constexpr std::size_t kSentBoxBytes = offsetof(SentBox, moving) + sizeof(std::uint16_t);

// Before the pixels of a strip: a part of the picture, all its pixels line by line.
struct StripHead {
  std::uint32_t moving;                     // 1: of the MFB, else of the CFB
  std::uint32_t first_line, last_line;      // [first, last)
  std::uint32_t first_column, last_column;  // [first, last)
};

// A pixel is red, green, blue and kDrawn, from the lowest byte on, 0 where nothing was drawn.
inline constexpr std::uint32_t kDrawn = 0xff000000u;

}  // namespace mars::machine1992
