// Where a node makes a frame's triangles and edge boxes. Nodes of a group on one machine have theirs in one block, so
// that each reads the others' where they lie; a triangle's number is its distance from the block's begin.
//
// A node publishes a keyframe's edge boxes, and its neighbours read them after the next sum over the group. It has two
// parts of the block, which take turns: while neighbours may still read a keyframe in one, the frames that follow are
// made in the other, which they have read for the last time before that sum.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/messages/private_memory.h"
#include "node/raster/arena.h"
#include "node/raster/neighbours.h"
#include "node/raster/scanline.h"

namespace mars::group {

class FrameMemory {
 public:
  // `bytes` a node. Where the machine does not let its nodes share that much, each has memory of its own. Collective
  // over a machine's nodes.
  FrameMemory(const raster::Neighbours& neighbours, std::uint64_t bytes);

  // Bytes for one frame, the same on all nodes of the job.
  std::size_t frame_bytes() const { return frame_bytes_; }
  // Why neighbours do not read each other's triangles; "" where they do, or where there are none.
  const std::string& refusal() const { return refusal_; }

  // The current frame's memory.
  raster::Arena& arena() { return arenas_[turn_]; }
  // Forgets what is in the arena, or gives the other part its turn.
  void begin_frame();
  // The caller needs it no more.
  void end_frame();
  // Of the block: triangles count from here.
  geometry::Triangle* first_triangle() const { return reinterpret_cast<geometry::Triangle*>(block_.data()); }

  // The other nodes of the group that read the caller's memory, and it theirs.
  std::span<const int> readers() const { return readers_; }
  bool reads(int node) const;
  // `own` lies in the arena, with all lines of the picture.
  void publish(const raster::LineBoxes& own);
  // Once all nodes of the group have published: adds what the readers have. They read the current frame's memory from
  // now on, which therefore loses its turn with the frame.
  void read_published(std::vector<raster::LineBoxes>& parts);

 private:
  // What a node has published, at the begin of the part. Places are bytes from the block's begin.
  struct Published {
    std::uint64_t boxes, box_count;
    std::uint64_t end, stationary_end, lines;
  };

  std::span<std::byte> part(int node, std::size_t turn) const;
  raster::LineBoxes published_by(int node) const;
  std::uint64_t place_of(const void* item) const;

  std::span<const int> nodes_;  // whose parts are in the block, in order
  std::size_t frame_bytes_;
  std::optional<raster::NeighboursMemory> shared_;
  messages::PrivateMemory own_;  // where nothing is shared
  std::string refusal_;
  std::span<std::byte> block_;
  std::vector<int> readers_;
  std::array<raster::Arena, 2> arenas_;
  std::size_t turn_ = 0;
  Published* head_ = nullptr;  // of the arena's part; nullptr where nobody else reads it
  bool is_read_ = false;       // the current frame, by neighbours
};

}  // namespace mars::group
