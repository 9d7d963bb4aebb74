// Pictures on their way out of a host, over a local socket: messages of a head of a fixed size, and a body. The host
// serves a studio, or renders a film that somebody watches; pictures are the same. Both ends are programs of one
// version on one machine, little-endian.
//
//   studio -> host             film, then scene, draw, close, in any number
//   host -> studio             begin (after each film), picture or dropped for every scene and draw, refused (its last)
//   rendering host -> watcher  begin (first after each connection), then picture and drawn, in any order
//   player -> window           begin, then picture and caption, in any order
//   window -> player           space (first), then key and space, in any order
//
// A serving host draws what is requested in turn. What is newer replaces what is older of the same view and has not
// begun; a scene that is requested also ends what is being drawn of its view. What is replaced or ended is answered by
// `dropped`. A rendering host never waits for its watcher, who sends nothing: a picture is of what is newest when the
// watcher takes it, and has every block that changed since the picture that the watcher took before. A player is the
// host of a window that it starts; its pictures are views, of the size that the window has space for.
#pragma once

#include <array>
#include <cstdint>

#include "host/render/compositor/rectangles.h"
#include "node/wire/protocol.h"

namespace mars::pictures {

enum class Kind : std::uint32_t {
  film = 1,  // body: a compiled film's block; all views end
  scene,     // body: a scene block (node/wire/scene.h): a new interval of a view, whose picture is its keyframe
  draw,      // body: DrawHead, then wire::MovedSegment ..., wire::MovedPatch ...: an inbetween of the view's interval
  close,     // no body: the view ends
  begin,     // body: Begin, then Node ...
  picture,   // body: PictureHead, Rect ..., Line ..., pixels
  dropped,   // no body
  drawn,     // body: DrawnHead, then Part ...
  refused,   // body: text, why the host ends
  caption,   // body: text, the title of a window
  key,       // body: Key
  space,     // body: Space
};

struct Head {
  Kind kind;
  std::uint32_t view = 0;     // scene, draw, close, picture, dropped; else 0
  std::uint32_t picture = 0;  // scene, draw, dropped, picture of a view: the studio's number, ascending over all views,
                              // from 1; else 0
  std::uint32_t unused = 0;
  std::uint64_t bytes = 0;  // of the body
};

struct DrawHead {
  std::uint32_t segments;
  std::uint32_t patches;
};

// All nodes have the film.
struct Begin {
  std::uint32_t width;  // of the film's frames
  std::uint32_t height;
  std::uint32_t block;   // side of a flag's block, pixels
  std::uint32_t groups;  // of nodes, each with an interval of its own
  std::uint32_t frames;  // that are to be drawn; 0: views
  std::uint32_t nodes;
};

struct Node {
  std::int32_t machine;       // as in wire::Hello
  std::array<char, 64> host;  // its name, zero-ended
};

struct PictureHead {
  std::uint32_t width;
  std::uint32_t height;
  std::uint32_t rects;
  std::uint32_t lines;  // as many as the height; 0 of a view
  std::uint32_t frame;  // 0 of a view, as the interval
  std::uint32_t interval;
  wire::FrameKind kind;
  std::uint32_t whole;  // 1: the picture is exactly this frame; 0: a keyframe of which lines are still to come, and
                        // these show what they showed before
  std::uint32_t group;  // that drew it: of a rendering the first that still has work
  std::uint32_t unused;
  double seconds;  // until the host put the last of it in place: of a view since the host began with it, of a rendering
                   // since the first command to the nodes
};

// Pixels that may differ from the picture sent before: all of the first (of a view: of the first in an interval), else
// those of flagged blocks, joined to rectangles that do not overlap. Their rows follow, rectangle after rectangle, four
// bytes a pixel: red, green and blue as they are shown, then of a view 255, of a rendering the pixel's Mark.
using compositor::Rect;

enum class Mark : std::uint8_t {
  nothing,  // is drawn there
  still,    // of CFB
  moving,   // of MFB
  unknown,  // drawn before the group was followed
};

struct Line {
  std::int32_t node;         // that drew it; -1: it is still to come
  std::uint32_t edge_boxes;  // EBC
};

// A frame that is whole, of any group. The newest thousand are kept for a watcher that is slow, or not there yet.
struct DrawnHead {
  std::uint32_t frame = 0;
  std::uint32_t interval = 0;
  wire::FrameKind kind = wire::FrameKind::keyframe;
  std::uint32_t group = 0;
  std::uint32_t parts = 0;
  std::uint32_t unused = 0;
  double given = 0;       // since the first command, when nodes were given the frame's task
  double seconds = 0;     // by the same clock, when it was whole
  double load_ratio = 0;  // as in wire::Strip
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

// A key that is pressed in a window: a character of ASCII, or one that has none.
enum class SpecialKey : std::uint32_t { none, up, down, left, right, home, end, back_tab, escape };

struct Key {
  SpecialKey special;
  std::uint32_t character;  // 0 unless `special` is none
};

// A window's, for a picture.
struct Space {
  std::uint32_t width;  // pixels
  std::uint32_t height;
};

}  // namespace mars::pictures
