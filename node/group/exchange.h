// What nodes of a group give each other in a keyframe: triangles, each once to every home of its scanlines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "node/geometry/line_range.h"
#include "node/group/pending_messages.h"
#include "node/raster/arena.h"
#include "node/raster/scanline.h"

namespace mars::group {

class TriangleExchange {
 public:
  // `nodes`: the most a group has; `lines`: of a picture.
  TriangleExchange(int nodes, std::size_t lines);

  // Begins to send to every other node of the group those of `own` triangles that have edge boxes on its lines,
  // `homes`, from copies in `arena`. They are gone after finish(). `line_counts`: own edge boxes a line.
  void send_triangles(const collectives::Group& group, const raster::Polygons& own,
                      std::span<const geometry::LineRange> homes, std::span<const std::uint32_t> line_counts,
                      raster::Arena& arena);
  // What another node, the `number`th of count - 1, sends; it lies in `arena`.
  raster::Polygons receive_triangles(const collectives::Group& group, int number, raster::Arena& arena);
  void finish();

 private:
  // What goes to one home.
  struct Parcel {
    std::span<geometry::Triangle> triangles;
    std::span<raster::UnsortedEdgeBox> boxes;
    std::size_t triangle_count = 0;  // filled from the front
    std::size_t box_count = 0;       // not filled yet, from the back
    std::uint32_t met =
        shading::kNoTriangle;  // the triangle last seen to go there: a triangle's edge boxes follow each other
  };

  void fill_parcels(const raster::Polygons& own, std::uint32_t self);

  PendingMessages pending_;
  std::vector<Parcel> parcels_;
  std::vector<std::uint32_t> home_of_;  // each line of some home: its index
};

}  // namespace mars::group
