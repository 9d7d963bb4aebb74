// What nodes of a cube give each other in a keyframe: triangles, each once to every home of its scanlines, and
// afterwards CZB to those that will draw inbetweens.
#pragma once

#include <span>
#include <vector>

#include "hal/cube.h"
#include "node/arena.h"
#include "node/mapping.h"
#include "node/scanline.h"

namespace mars::node {

class Exchange {
 public:
  explicit Exchange(int nodes);

  // `own`: the calling node's triangles, one source. `homes`: lines of each of the cube's nodes. Returns with them
  // the triangles that others have on the caller's lines, in `arena` behind the own ones, where there must be room
  // for them and for a copy of what is sent.
  Polygons triangles(const hal::Cube& cube, const Polygons& own, std::span<const LineRange> homes, Arena& arena);

  // Returns when lines `needed` of `czb` are whole on the caller's machine, if draws[index] is set for it, all nodes of
  // the cube having written theirs there: lines go once to every other machine where a node draws.
  void depth_lines(const hal::Cube& cube, std::span<const LineRange> homes, const LineRange& needed,
                   std::span<const std::uint8_t> draws, Czb& czb);

 private:
  void send_triangles(int node, const Polygons& own, const LineRange& home, Arena& arena);
  void receive_triangles(int node, const Triangle* first, Arena& arena);
  void collect_depth(const hal::Cube& cube, std::span<const LineRange> homes, const LineRange& needed, Czb& czb);
  void wait_all();

  std::vector<long> pending_;  // message ids
  std::vector<Polygons::Source> sources_;
};

}  // namespace mars::node
