#include "node/group/exchange.h"

#include <algorithm>
#include <utility>

#include "hal/nx/nx_messages.h"
#include "node/wire/protocol.h"

namespace mars::group {
namespace {

// visit(unsorted) for all own edge boxes in the order of polygon numbers: those that stand still, then the others.
template <typename Visit>
void visit_all(const raster::Polygons& polygons, const Visit& visit) {
  for (const auto& boxes : {polygons.stationary, polygons.moving})
    for (auto next = boxes.rbegin(); next != boxes.rend(); ++next) visit(*next);
}

template <typename T>
long bytes_of(std::span<T> items) {
  return static_cast<long>(items.size_bytes());
}

}  // namespace

TriangleExchange::TriangleExchange(int nodes, std::size_t lines)
    : pending_(2 * static_cast<std::size_t>(nodes)), parcels_(static_cast<std::size_t>(nodes)), home_of_(lines) {}

void TriangleExchange::send_triangles(const collectives::Group& group, const raster::Polygons& own,
                                      std::span<const geometry::LineRange> homes,
                                      std::span<const raster::LineLoad> line_loads, raster::Arena& arena) {
  const auto self = static_cast<std::size_t>(mynode() - group.first);
  if (homes.size() == 1) return;
  for (std::size_t home = 0; home < homes.size(); ++home) {
    const auto on_home = [&](const auto& lines) { return lines.subspan(homes[home].first, homes[home].count()); };
    std::ranges::fill(on_home(std::span(home_of_)), static_cast<std::uint32_t>(home));
    std::size_t boxes = 0;
    if (home != self)
      for (const raster::LineLoad& load : on_home(line_loads)) boxes += load.boxes();
    // Capacity for one triangle an edge box, the most there can be.
    parcels_[home] = {arena.take<geometry::Triangle>(boxes), arena.take<raster::UnsortedEdgeBox>(boxes), 0, boxes,
                      shading::kNoTriangle};
  }
  fill_parcels(own, static_cast<std::uint32_t>(self));
  for (std::size_t i = 1; i < homes.size(); ++i) {
    const std::size_t index = (self + i) % homes.size();  // so that not all send to the same node first
    const Parcel& parcel = parcels_[index];
    const long node = group.first + static_cast<long>(index);
    const auto triangles = parcel.triangles.first(parcel.triangle_count);
    pending_.add(isend(wire::triangles_from(mynode()), triangles.data(), bytes_of(triangles), node, 0));
    pending_.add(isend(wire::edge_boxes_from(mynode()), parcel.boxes.data(), bytes_of(parcel.boxes), node, 0));
  }
}

// As a node has its own: triangles in order and numbered from 0, edge boxes from the last to the first.
void TriangleExchange::fill_parcels(const raster::Polygons& own, std::uint32_t self) {
  visit_all(own, [&](const raster::UnsortedEdgeBox& unsorted) {
    const std::uint32_t home = home_of_[unsorted.line];
    if (home == self) return;
    Parcel& parcel = parcels_[home];
    if (std::exchange(parcel.last_triangle, unsorted.box.triangle) != unsorted.box.triangle)
      parcel.triangles[parcel.triangle_count++] = own.triangles[unsorted.box.triangle];
    raster::UnsortedEdgeBox& copy = parcel.boxes[--parcel.box_count] = unsorted;
    copy.box.triangle = static_cast<std::uint32_t>(parcel.triangle_count - 1);
  });
}

raster::Polygons TriangleExchange::receive_triangles(const collectives::Group& group, int number,
                                                     raster::Arena& arena) {
  const int self = static_cast<int>(mynode()) - group.first;
  const int node = group.first + (self + group.count - number) % group.count;
  cprobe(wire::triangles_from(node));
  const auto triangles =
      arena.take<geometry::Triangle>(static_cast<std::size_t>(infocount()) / sizeof(geometry::Triangle));
  crecv(wire::triangles_from(node), triangles.data(), bytes_of(triangles));
  cprobe(wire::edge_boxes_from(node));
  const auto boxes =
      arena.take<raster::UnsortedEdgeBox>(static_cast<std::size_t>(infocount()) / sizeof(raster::UnsortedEdgeBox));
  crecv(wire::edge_boxes_from(node), boxes.data(), bytes_of(boxes));
  const auto first_stationary = std::partition_point(
      boxes.begin(), boxes.end(), [](const raster::UnsortedEdgeBox& box) { return box.moving == 1; });
  const auto moving = static_cast<std::size_t>(first_stationary - boxes.begin());
  return {triangles.data(), boxes.subspan(moving), boxes.first(moving)};
}

void TriangleExchange::finish() { pending_.wait(); }

}  // namespace mars::group
