// The exchange of triangles within a group in a keyframe, with the nodes whose memory the caller cannot read: each is
// sent once to every home of its scanlines. A message is sent only where it carries something: how many edge boxes come
// to a home follows from EBC, so that it takes messages in the order of their arrival until it has them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "node/geometry/line_range.h"
#include "node/group/frame_memory.h"
#include "node/group/pending_messages.h"
#include "node/group/triangle_message.h"
#include "node/raster/line_load.h"
#include "node/raster/scanline.h"
#include "node/wire/protocol.h"

namespace mars::group {

class TriangleExchange {
 public:
  // `nodes`: the most a group has; `lines`: of a picture.
  TriangleExchange(std::size_t nodes, std::size_t lines);

  // Begins to send to every other node of the group, unless it reads `memory`, those of `own` triangles that have edge
  // boxes on its lines, `homes`, from copies in the arena. They are gone after finish(). `line_loads`: of own
  // triangles.
  void send_triangles(const collectives::Group& group, const raster::Polygons& own,
                      std::span<const geometry::LineRange> homes, std::span<const raster::LineLoad> line_loads,
                      FrameMemory& memory);
  // Receives the next node's, of those awaited; they lie in the arena.
  raster::Polygons receive_triangles(FrameMemory& memory, AwaitedTriangles& awaited);
  // Waits until all that was sent has left the arena.
  void finish();

 private:
  // The triangles for one home.
  struct Parcel {
    int node;
    std::span<std::byte> message;
    raster::UnsortedEdgeBox* next_box;  // filled from the back
    geometry::Triangle* triangles;
    std::uint64_t triangle_count = 0;  // filled from the front
    // The last triangle that goes there: a triangle's edge boxes follow each other.
    std::uint32_t last_triangle = shading::kNoTriangle;
  };

  void fill_parcels(const raster::Polygons& own);

  PendingMessages pending_;
  std::vector<Parcel> parcels_;
  std::vector<std::uint32_t> parcel_of_;  // by line, kNoParcel where none; only lines of `homes` are set
};

}  // namespace mars::group
