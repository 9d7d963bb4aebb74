// The messages between host and node: their types and their bodies, plain little-endian structs followed by arrays
// where said. The node owns this page; the host includes it and nothing else of the firmware. A node boots, sends Hello
// and then only executes. Hello and Load begin with a stamp that tells versions apart (stamp.h). Stop may come while
// nodes draw: each then finishes the keyframes it was given, for the others of its group wait for it, draws no more
// inbetweens, sends no more strips and ends. Both sides check a message's size, counts and ranges before they use
// anything of it: the node in commands.h, the host in host/render/farm/node_inbox.h.
//
// A node makes its strips in slots of its own memory. A slot is the node's from the Credit that gives it until the
// Strip that was made in it, and the host's from then until the next such Credit. On one machine the host reads pixels
// and runs where they lie; elsewhere they travel in the Strip. The host reads no slot after Stop, nor once it has
// declared a node lost: then the run ends.
//
//   host -> node   Load (+ film block to the first node, in pieces), Write, Credit ..., Render ..., Stop; live views
//                  have BeginView, Draw and CloseView ... instead of Render, and may have another Load
//   node -> host   Hello, Loaded, Strip ..., Fault (its last message)
//   both ways      Clock, when the run is traced; then also node -> host Trace ...
//   both ways      Beat, at any time
//   node -> node   film block to one node a machine; counts a line; Triangles and StillLines, in any order of the
//   senders: those of two keyframes, or of
//                  two passes of one, cannot mix, for all nodes of the group meet between them; Bands, each sender's in
//                  the order of the frames
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/collectives/group.h"
#include "hal/messages/offer.h"
#include "node/wire/film_parts.h"
#include "node/wire/pixel_format.h"
#include "node/wire/run.h"
#include "node/wire/stamp.h"
#include "node/wire/work.h"

namespace mars::wire {

// Types are below 30, so that one NX type selector can name a set of them.
enum MessageType : long {
  kHello = 1,
  kLoad,
  kFilmBlock,
  kLoaded,
  kRender,
  kCredit,
  kStrip,
  kFault,
  kStop,
  kClock,       // host -> node: empty, asks for the time; node -> host: its dclock(), a double
  kTrace,       // messages::Event ..., closed by one of kind lost
  kTriangles,   // TriangleHead, edge boxes, triangles, each from a cache line on
  kStillLines,  // what inbetweens need of home lines (raster/still_lines.h), in pieces that go round machines
                // (group/relay.h); empty within a machine, once they are written
  kBeat,
  kBeginView,  // BeginView, then a scene block: begins an interval of a view
  kDraw,       // Draw, then what moved: the next inbetween of a view's interval
  kCloseView,  // CloseView
  // Of runs in which nodes write their frames' files (frame_writer.h).
  kDrawn,       // a Strip without pixels: the node has drawn its part of the frame
  kWritten,     // Written
  kStorage,     // node -> host: text, a warning about storage
  kEdge,        // lines of a band, for the node that composes it
  kBackground,  // what inbetweens need of bands, in pieces as still lines; empty within a machine, once they are there
  kPicture,     // the sender's bands of a keyframe, for the node that writes it
  kWrite,       // host -> node, before any Render: empty; the node's group writes its frames. Other groups send strips
  kBands,       // InbetweenBands, then the sender's bands of an inbetween, for the node of its team that writes it;
                // empty: no more are to come
};

// Bands of an inbetween.
struct InbetweenBands {
  std::uint32_t frame;
  std::uint32_t unused = 0;
};

// Of triangles and their edge boxes on the receiver's lines.
struct TriangleHead {
  std::uint64_t edge_boxes;
  std::uint64_t triangles;
};

// The NX type selector for any of several types below 30.
template <typename... Types>
constexpr long any_of(Types... types) {
  return static_cast<long>(-0x80000000L + (0L + ... + (1L << types)));
}

// A node's identity. Strings are zero-ended.
struct Hello {
  WireStamp stamp;
  std::array<char, 64> host;  // name of its machine
  std::int32_t node;
  std::int32_t machine;              // lowest node id on the same machine; its own if it shares no memory with them
  std::int32_t rank;                 // its number in the job that started it (MPI's)
  std::array<std::int32_t, 5> seat;  // core, L2, L3, NUMA domain, package that hold it; -1: several
  std::uint64_t memory;              // bytes it may use for its frames, still lines and shadows
  std::array<char, 64> binding;      // processors it is bound to, as hwloc lists them; "" if free
  std::array<char, 16> simd;         // widest instruction set its kernels use
  std::array<char, 128> apart;       // why it shares no memory with other nodes of its machine; "" if it does
};

static_assert(offsetof(Hello, host) == sizeof(WireStamp), "where every version has it");

enum class Mapping : std::uint32_t { greedy, optimal, cost };

// How triangles come to the homes of their lines on other machines: they are sent; or the homes make them again, which
// is work instead of messages; or that where it took less than half the time in earlier keyframes.
enum class Exchange : std::uint32_t { automatic, send, again };

// What a keyframe's sums have of a picture, in words of 8 bytes: each line's load; edge boxes; nodes with large frames;
// two times of the exchange.
constexpr std::size_t summed_words(std::size_t lines) { return lines + 4; }

// Bytes of the film block in one kFilmBlock message; the last has the rest. Few, for nodes pass on what they have while
// more comes.
inline constexpr std::uint64_t kFilmPiece = std::uint64_t{1} << 20;

// Slots that a node has at most.
inline constexpr std::int32_t kMaxCredits = 4;

// Prepares a film of `film_bytes`. Followed by each node's machine (int32), as in Hello. Nodes that lead a machine get
// the block next, as kFilmBlock messages, and pass it on (node/film_receiver.h).
struct Load {
  WireStamp stamp;
  std::uint64_t film_bytes;
  std::uint64_t memory;  // bytes for triangles and edge boxes of a node's frames, the same on every node
  std::int32_t credits;  // slots that the node makes for its strips, 1..kMaxCredits; all are the host's at first
  Mapping mapping;
  std::int32_t groups;   // that the nodes form side by side (collectives::group_of), for all Render commands
  std::uint32_t traced;  // 1: the node records what it does and sends it as Trace
  PixelFormat pixel_format;
  Exchange exchange;
  std::uint64_t still_memory;  // bytes that a node adds to what its machine keeps of stationary parts for inbetweens
  std::uint32_t live;     // 1: BeginViews and Draws follow, no Renders; another Load may come, which ends all views
  std::uint32_t watched;  // 1: strips say how many edge boxes each of their lines has
  std::uint64_t shadow_memory;  // bytes for drawing shadows, on every node
  std::uint64_t orders;         // bytes behind the machines, for the node's frame writer; 0: all frames go to the host
};

// The node has the film and its slots.
struct Loaded {
  messages::MemoryName slots;   // `credits` of slot_bytes each
  std::array<char, 256> apart;  // why it does not read the triangles of nodes with which it shares memory; "": it does
  std::uint32_t unseen = 0;     // 1: its machine does not see the folder into which it is to write
};

// Frames of one interval for one group: the first is the keyframe, rendered by the group's first `contributors` nodes,
// each of the others goes to one team of nodes, which divide its lines (team_of_inbetween). They follow each other from
// first_frame on; or, where `listed` is 1, their numbers (uint32), ascending, follow the struct. Then follows the cycle
// of `cycle` teams (int32).
//
// Only the first `drawn` frames are drawn now. The others are in Renders that go on: these have inbetweens alone, the
// next of those left, and draw all of them.
struct Render {
  std::uint32_t interval;
  std::int32_t group_first;
  std::int32_t group_count;
  std::int32_t contributors;  // 1..group_count
  std::uint32_t frame_count;
  std::uint32_t first_frame;
  std::uint64_t first_inbetween;  // number in the film of the first inbetween here
  std::uint32_t drawn;            // 1..frame_count
  std::uint16_t cycle;            // 0: turns
  std::uint8_t listed;
  std::uint8_t goes_on;
  std::int32_t teams = 0;  // that the group's nodes form side by side, 1..group_count; 0: each node is one
  std::uint32_t unused = 0;
};

// Teams in a cycle, at most.
inline constexpr std::size_t kMostCycle = 0xffff;

// The teams of a group, `teams` as in Render.
constexpr std::int32_t team_count(const collectives::Group& group, std::int32_t teams) {
  return teams == 0 ? group.count : teams;
}

constexpr collectives::Group team_of(const collectives::Group& group, std::int32_t teams, std::int32_t number) {
  const collectives::Group team = collectives::group_of(group.count, team_count(group, teams), number);
  return {group.first + team.first, team.count};
}

// The team that has the node.
constexpr collectives::Group own_team(std::int32_t node, const collectives::Group& group, std::int32_t teams) {
  for (std::int32_t number = 0; number < team_count(group, teams); ++number)
    if (const auto team = team_of(group, teams, number); node < team.first + team.count) return team;
  return {node, 1};
}

// The team that draws an inbetween: by the cycle over the whole film, or in turns where there is none. `inbetween` is
// the inbetween's number in the film (Render::first_inbetween and on).
constexpr collectives::Group team_of_inbetween(std::uint64_t inbetween, const collectives::Group& group,
                                               std::int32_t teams, std::span<const std::int32_t> cycle = {}) {
  if (!cycle.empty()) return team_of(group, teams, cycle[inbetween % cycle.size()]);
  return team_of(group, teams,
                 static_cast<std::int32_t>(inbetween % static_cast<std::uint64_t>(team_count(group, teams))));
}

// The node of that team that writes it, where nodes write files: they take turns.
constexpr std::int32_t writer_of_inbetween(std::uint64_t inbetween, const collectives::Group& group, std::int32_t teams,
                                           const collectives::Group& team) {
  const std::uint64_t turn = inbetween / static_cast<std::uint64_t>(team_count(group, teams));
  return team.first + static_cast<std::int32_t>(turn % static_cast<std::uint64_t>(team.count));
}

// Gives a slot, which is permission to send one strip.
struct Credit {
  std::uint32_t slot;        // below Load's credits
  std::uint32_t by_message;  // 1: the host does not see the slot, and the strip travels whole
};

// Seconds spent so far in the steps of one frame on one node; the frame's last strip has them all.
struct PhaseTimes {
  double dice;      // patches to triangles and their counts
  double sum;       // global sum of EBC
  double map;       // mapping of scanlines
  double exchange;  // triangles to the homes of their lines
  double fill;      // edge boxes into place
  double scanline;  // visibility and shading
  double shadow;    // which points of lights' views casters block
  double depth;     // until all of CZB is there
  double credit;    // waiting for the host: for its credit, or until the slot's earlier strip is gone
  double compose;   // of a node that writes files: bands to records, of the frame and for it
  double bands;     // bands to other nodes, and waiting for theirs
  double storage;   // waiting until earlier files are written
};

// The spans of a trace: these steps, and the frame around them, whose value is its interval.
enum class Phase : std::int32_t {
  dice,
  sum,
  map,
  exchange,
  fill,
  scanline,
  shadow,
  depth,
  credit,
  compose,
  bands,
  storage,
  keyframe,
  inbetween
};
inline constexpr std::array kPhaseNames{"dice",  "sum",    "map",     "exchange", "fill",    "scanline", "shadow",
                                        "depth", "credit", "compose", "bands",    "storage", "keyframe", "inbetween"};

// Says that its sender lives. The host beats every few seconds from its start until its end. A node that has heard a
// beat sends its own, one a second at most, while it works and while it waits; and ends when it hears none for long. A
// host whose machine is simulated does not beat, and so nobody does.
struct Beat {
  std::array<char, 64> host{};  // name of the sender's machine, zero-ended
  std::int32_t process = 0;     // its number there
  std::uint32_t traced = 0;     // 1: a debugger has it
  std::int32_t frame = -1;      // that a node draws; -1: none
  Phase phase = Phase::dice;    // of this frame, a step
  std::uint32_t waits = 0;      // 1: for a message or for other nodes
};

// Live views. A studio's host loads a film with Load::live = 1 and then gives BeginViews and Draws instead of Renders,
// to nodes that are one group. A view is a picture of its own size, seen by its own camera, of which each node keeps
// what inbetweens need. The film gives shapes; a scene block (scene.h) gives all else. Pictures are numbered by the
// host over all views; in a Strip, `frame` is the picture's number and `interval` its view. Another Load ends all
// views: from then until Loaded nodes send no strips but those on their way, and the host gives no credit; slots are
// new.

inline constexpr std::uint32_t kMostViews = 64;

// To all nodes: makes the view, or changes its size, and begins an interval of it. All nodes draw the picture, as a
// keyframe. What was asked for of the view before and is not drawn yet is cut short: each node that has to do with it
// still sends its last strip. So does CloseView. Followed by the scene block.
struct BeginView {
  std::uint32_t view;     // below kMostViews
  std::uint32_t picture;  // 1, 2, ...
  std::uint64_t scene_bytes;
  std::uint64_t still_memory;   // as in Load, for this view
  std::uint64_t shadow_memory;  // and for shadows
};

// To the node that draws it: a picture of the view's interval, an inbetween. Followed by all that differs from the
// keyframe's scene, each kind 8-aligned: MovedSegment ..., MovedPatch ...
struct Draw {
  std::uint32_t view;
  std::uint32_t picture;
  std::uint32_t segments;
  std::uint32_t patches;
};

// A segment of the interval's moving ones, where it is now and what it is made of. Or where a bone of one is: bones are
// numbered behind all segments.
struct MovedSegment {
  std::uint32_t segment;
  std::uint32_t material;  // of the scene's; of a bone any
  Matrix matrix;
};

// A patch of the scene block (not of the film), of moving segments' shapes alone.
struct MovedPatch {
  std::uint32_t patch;  // counted from the scene block's first
  std::uint32_t unused = 0;
  Patch points;
};

// To all nodes: the view is no more.
struct CloseView {
  std::uint32_t view;
};

// Work of one node for one frame so far; the frame's last strip has it all.
struct WorkCounts {
  std::uint64_t patches;  // diced, and meshlets
  std::uint64_t vertices;
  std::uint64_t triangles_tested;   // made of patches and meshlets
  std::uint64_t triangles;          // triangles that touch a sample
  std::uint64_t edge_boxes_diced;   // of those triangles
  std::uint64_t edge_boxes;         // drawn on its own lines
  std::uint64_t samples;            // that these cover
  std::uint64_t pixels;             // shaded
  std::uint64_t lines_drawn_again;  // lines of an inbetween whose stationary parts were not kept
  std::uint64_t bytes_to_nodes;
  std::uint64_t bytes_to_host;   // in strips, whether by slot or by message
  std::uint64_t memory;          // bytes of the frame's arena in use at the peak
  std::uint32_t passes;          // over line ranges; 1 unless memory was short
  std::uint32_t credits_waited;  // strips that had to wait for credit
  NodeUnits charged;             // by kind
};

enum class FrameKind : std::uint32_t { keyframe, inbetween };

// A frame's file is under its name, whole.
struct Written {
  std::uint32_t frame;
  std::int32_t node;
  std::array<char, 48> pixel_hash;  // zero-ended
  std::uint64_t bytes;
  double seconds;  // that writing took
};

// Bytes of a strip, header and all, at most: few enough to stay in a core's cache on their way, and the host puts them
// in place while the node draws on. A line of a wide picture with layers may take five times as many.
inline constexpr std::size_t kMaxStripBytes = std::size_t{768} << 10;
constexpr std::size_t max_strip_bytes(PixelFormat format) {
  return layers_of(format) == 0 ? kMaxStripBytes : 5 * kMaxStripBytes;
}

// Of a slot, which has a strip from its beginning on. More than a strip, for while it is made the two kinds of pixels
// lie apart.
constexpr std::size_t slot_bytes(PixelFormat format) { return 2 * max_strip_bytes(format) + 4096; }
inline constexpr std::size_t kSlotBytes = slot_bytes(PixelFormat::rgb8);

// A part of one node's part of one frame: the pixels of its stationary parts (CFB, keyframes only) and then those of
// its moving parts (MFB). Followed by all pixels in Load's format, then by constant_runs + moving_runs Run that say
// where they go, in the same order; in watched runs then by EBC (uint32) of each line of [first_line, last_line). The
// message has all that by_message; else it ends with the struct, and the rest lies behind it in the slot.
struct Strip {
  std::uint32_t frame;
  std::uint32_t interval;
  FrameKind kind;
  std::int32_t node;
  std::uint32_t number;      // of the strips that this node sends for this frame, from 0
  std::uint16_t last;        // 1 if this is the last of them; a frame is whole when all nodes' last came
  std::uint16_t cut;         // 1: the last, though lines are left out, as the view or its interval has ended
  std::uint32_t first_line;  // it is of the node's home lines [first_line, last_line)
  std::uint32_t last_line;
  std::uint32_t constant_runs;
  std::uint32_t moving_runs;
  std::uint32_t slot;        // it was made in
  std::uint32_t by_message;  // as the slot's Credit said
  std::uint64_t pixels;
  std::uint64_t edge_box_total;  // EBC's last entry (keyframes)
  double load_ratio;             // max / average of what the mapping makes even (keyframes; 1 for an inbetween)
  PhaseTimes times;
  WorkCounts work;
};

// A node has failed; the whole run stops.
struct Fault {
  std::int32_t node;
  std::int32_t frame;  // -1: before any
  std::array<char, 1024> reason;
};

}  // namespace mars::wire
