// What a studio and its serving host say to each other over a local socket: heads of a fixed size, each with its body.
// Both are programs of one version on one machine, little-endian.
//
//   studio -> host   film, then view, draw, close, in any number
//   host -> studio   ready (after each film), picture or dropped for every view and draw, refused (its last)
//
// The host draws what is asked for in turn. What is newer replaces what is older of the same view and has not begun; a
// view asked for also ends what is being drawn of that view. Whatever is replaced or ended is answered by `dropped`.
#pragma once

#include <cstdint>

#include "host/render/compositor/rectangles.h"

namespace mars::serve {

enum class Kind : std::uint32_t {
  film = 1,  // body: a compiled film's block; all views end
  view,      // body: a scene block (node/wire/scene.h): a new interval of a view, whose picture is its keyframe
  draw,      // body: DrawHead, then wire::MovedSegment ..., wire::MovedPatch ...: an inbetween of the view's interval
  close,     // no body: the view ends
  ready,     // body: Ready
  picture,   // body: PictureHead, Rect ..., pixels
  dropped,   // no body
  refused,   // body: text, why the host ends
};

struct Head {
  Kind kind;
  std::uint32_t view;     // view, draw, close, picture, dropped; else 0
  std::uint32_t picture;  // view, draw, picture, dropped: the asker's number, ascending over all views, from 1; else 0
  std::uint32_t unused = 0;
  std::uint64_t bytes;  // of the body
};

struct DrawHead {
  std::uint32_t segments;
  std::uint32_t patches;
};

struct Ready {
  std::uint32_t nodes;
  std::uint32_t machines;
};

// Pixels that may differ from the view's picture sent before: of the first in an interval all, else those of flagged
// blocks, joined to rectangles that do not overlap. Their rows follow, rectangle after rectangle, four bytes a pixel:
// red, green, blue, 255.
struct PictureHead {
  std::uint32_t width;
  std::uint32_t height;
  std::uint32_t rects;
  std::uint32_t nodes;  // that drew it
  double seconds;       // since the host began with it
  double load_ratio;    // of a keyframe, as in wire::Strip
  std::uint64_t triangles;
  std::uint64_t edge_boxes;
};

using compositor::Rect;

inline constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 40;  // of a body

}  // namespace mars::serve
