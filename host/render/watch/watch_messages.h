// What a rendering host says to who watches it, over a local socket at which the watcher listens: heads of a fixed
// size, each with its body. Both are programs of one version on one machine, little-endian.
//
//   host -> watcher   begin (first, and again after each connection), then picture and drawn, in any order
//
// The watcher says nothing. The host never waits for it: a picture is of what is newest when the watcher takes it, and
// has every block that changed since the picture it took before.
#pragma once

#include <array>
#include <cstdint>

#include "host/render/compositor/rectangles.h"
#include "node/wire/protocol.h"

namespace mars::watch {

enum class Kind : std::uint32_t {
  begin = 1,  // body: Begin, then Node ...
  picture,    // body: PictureHead, Rect ..., Line ..., pixels
  drawn,      // body: DrawnHead, then Part ...
};

struct Head {
  Kind kind;
  std::uint32_t unused = 0;
  std::uint64_t bytes;  // of the body
};

struct Begin {
  std::uint32_t width;
  std::uint32_t height;
  std::uint32_t block;   // side of a flag's block, pixels
  std::uint32_t groups;  // of nodes, each with an interval of its own
  std::uint32_t frames;  // that are to be drawn
  std::uint32_t nodes;
};

struct Node {
  std::int32_t machine;       // as in wire::Hello
  std::array<char, 64> host;  // its name, zero-ended
};

// Of one group: the first that still has work.
struct PictureHead {
  std::uint32_t frame;
  std::uint32_t interval;
  wire::FrameKind kind;
  std::uint32_t whole;  // 1: the picture is exactly this frame; 0: a keyframe of which lines are still to come, and
                        // these show what they showed before
  std::uint32_t group;
  std::uint32_t rects;
  double seconds;  // since the first command to the nodes, when the host put the last of it in place
};

// Blocks that were flagged, joined to rectangles that do not overlap. Pixels are rows of rectangle after rectangle.
using compositor::Rect;

// Of each line of the picture.
struct Line {
  std::int32_t node;         // that drew it; -1: it is still to come
  std::uint32_t edge_boxes;  // EBC
};

// A pixel's red, green and blue from its lowest byte on, of 8 bits each, as they are shown; and what it is.
enum class Mark : std::uint8_t {
  nothing,  // is drawn there
  still,    // of CFB
  moving,   // of MFB
  unknown,  // drawn before the group was followed
};

// A frame that is whole, of any group. The newest thousand are kept for a watcher that is slow, or not there yet.
struct DrawnHead {
  std::uint32_t frame;
  std::uint32_t interval;
  wire::FrameKind kind;
  std::uint32_t group;
  std::uint32_t parts;
  std::uint32_t unused = 0;
  double given;       // since the first command, when nodes were given the frame's task
  double seconds;     // by the same clock, when it was whole
  double load_ratio;  // as in wire::Strip
};

// A node's part of it.
struct Part {
  std::int32_t node;
  std::uint32_t first_line, last_line;  // its home [first_line, last_line)
  std::uint32_t strips;
  double ended;  // seconds since the first command, when its last strip had come
  wire::PhaseTimes times;
  std::uint64_t triangles;
  std::uint64_t edge_boxes;  // drawn on its lines
  std::uint64_t pixels;
};

}  // namespace mars::watch
