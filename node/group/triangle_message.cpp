#include "node/group/triangle_message.h"

#include <algorithm>

#include "node/wire/commands.h"
#include "node/wire/protocol.h"

namespace mars::group {
namespace {

static_assert(kBoxesAt == whole_cache_lines(sizeof(wire::TriangleHead)));

bool has_size(std::span<const std::byte> message, const wire::TriangleHead& head) {
  const std::size_t size = message.size();
  return head.edge_boxes > 0 && head.edge_boxes <= size / sizeof(raster::UnsortedEdgeBox) &&
         head.triangles <= size / sizeof(geometry::Triangle) &&
         size == triangles_at(head.edge_boxes) + head.triangles * sizeof(geometry::Triangle);
}

bool take(std::span<const raster::UnsortedEdgeBox> boxes, std::uint64_t triangles, AwaitedTriangles& awaited) {
  const std::uint32_t first = awaited.lines.first, count = awaited.lines.count();
  return std::ranges::all_of(boxes, [&](const raster::UnsortedEdgeBox& unsorted) {
    const std::uint32_t line = unsorted.line - first;
    const raster::EdgeBox& box = unsorted.box;
    return line < count && awaited.boxes[line]-- > 0 && box.triangle < triangles && box.last() <= awaited.width &&
           box.sample < awaited.samples;
  });
}

}  // namespace

raster::Polygons read_triangles(std::span<const std::byte> message, AwaitedTriangles& awaited, int sender) {
  constexpr const char* kWhat = "triangles";
  wire::require_sense(message.size() >= kBoxesAt, sender, kWhat);
  const auto& head = *reinterpret_cast<const wire::TriangleHead*>(message.data());
  wire::require_sense(has_size(message, head), sender, kWhat);
  const std::span boxes(reinterpret_cast<const raster::UnsortedEdgeBox*>(message.data() + kBoxesAt), head.edge_boxes);
  const std::span triangles(reinterpret_cast<const geometry::Triangle*>(message.data() + triangles_at(boxes.size())),
                            head.triangles);
  const bool known = std::ranges::all_of(
      triangles, [&](const geometry::Triangle& triangle) { return triangle.material < awaited.materials; });
  wire::require_sense(known && take(boxes, triangles.size(), awaited), sender, kWhat);
  const auto first_stationary =
      std::ranges::partition_point(boxes, [](const raster::UnsortedEdgeBox& box) { return box.moving == 1; });
  const auto moving = static_cast<std::size_t>(first_stationary - boxes.begin());
  return {triangles.data(), boxes.subspan(moving), boxes.first(moving)};
}

}  // namespace mars::group
