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

  // Begins to send to every other node of the cube those of `own` triangles that have edge boxes on its lines,
  // `homes`, from copies in `arena`. They are gone after finish().
  void send_triangles(const hal::Cube& cube, const Polygons& own, std::span<const LineRange> homes, Arena& arena);
  // What another node, the `number`th of count - 1, sends; it lies in `arena`.
  Polygons receive_triangles(const hal::Cube& cube, int number, Arena& arena);
  void finish();

  // Returns when lines `needed` of `czb` are whole on the caller's machine, if draws[index] is set for it, all nodes of
  // the cube having written theirs there: lines go once to every other machine where a node draws.
  void depth_lines(const hal::Cube& cube, std::span<const LineRange> homes, const LineRange& needed,
                   std::span<const std::uint8_t> draws, Czb& czb);

 private:
  void send_triangles_to(int node, const Polygons& own, const LineRange& home, Arena& arena);
  void collect_depth(const hal::Cube& cube, std::span<const LineRange> homes, const LineRange& needed, Czb& czb);

  std::vector<long> pending_;  // message ids
};

}  // namespace mars::node
