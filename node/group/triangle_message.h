// A message of triangles and their edge boxes (kTriangles) as it came from another node, checked before anything of it
// is used: with what is let through, nothing that draws can reach beyond its arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "node/geometry/line_range.h"
#include "node/raster/line_boxes.h"

namespace mars::group {

// What may still come.
struct AwaitedTriangles {
  geometry::LineRange lines;
  std::span<std::uint64_t> boxes;  // of each line
  std::uint32_t width;             // of the picture, pixels
  std::uint32_t samples;           // of a pixel
  std::size_t materials;           // of the film
};

// Where the parts of a message begin.
constexpr std::size_t whole_cache_lines(std::size_t bytes) { return (bytes + 63) / 64 * 64; }
inline constexpr std::size_t kBoxesAt = whole_cache_lines(2 * sizeof(std::uint64_t));
constexpr std::size_t triangles_at(std::size_t edge_boxes) {
  return whole_cache_lines(kBoxesAt + edge_boxes * sizeof(raster::UnsortedEdgeBox));
}

// What `message`, which begins at a cache line, holds; `awaited` has that less to come. Throws Failure naming `sender`
// where it is anything but a part of that.
raster::Polygons read_triangles(std::span<const std::byte> message, AwaitedTriangles& awaited, int sender);

}  // namespace mars::group
