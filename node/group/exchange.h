// The exchange of triangles within a group in a keyframe: each is sent once to every home of its scanlines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "node/geometry/line_range.h"
#include "node/group/pending_messages.h"
#include "node/raster/arena.h"
#include "node/raster/line_load.h"
#include "node/raster/scanline.h"

namespace mars::group {

class TriangleExchange {
 public:
  // `nodes`: the most a group has; `lines`: of a picture.
  TriangleExchange(int nodes, std::size_t lines);

  // Begins to send to every other node of the group those of `own` triangles that have edge boxes on its lines,
  // `homes`, from copies in `arena`. They are gone after finish(). `line_loads`: of own triangles.
  void send_triangles(const collectives::Group& group, const raster::Polygons& own,
                      std::span<const geometry::LineRange> homes, std::span<const raster::LineLoad> line_loads,
                      raster::Arena& arena);
  // Receives from another node, the `number`th of count - 1; the result lies in `arena`.
  raster::Polygons receive_triangles(const collectives::Group& group, int number, raster::Arena& arena);
  // Waits until all that was sent has left `arena`.
  void finish();

 private:
  // The triangles for one home.
  struct Parcel {
    std::span<geometry::Triangle> triangles;
    std::span<raster::UnsortedEdgeBox> boxes;
    std::size_t triangle_count = 0;  // filled from the front
    std::size_t box_count = 0;       // not filled yet, from the back
    // The last triangle that goes there: a triangle's edge boxes follow each other.
    std::uint32_t last_triangle = shading::kNoTriangle;
  };

  void fill_parcels(const raster::Polygons& own, std::uint32_t self);

  PendingMessages pending_;
  std::vector<Parcel> parcels_;
  std::vector<std::uint32_t> home_of_;  // by line: index of its home; only lines of `homes` are set
};

}  // namespace mars::group
