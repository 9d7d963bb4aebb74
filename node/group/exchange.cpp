#include "node/group/exchange.h"

#include <algorithm>
#include <utility>

#include "hal/nx/nx_messages.h"

namespace mars::group {
namespace {

constexpr std::uint32_t kNoParcel = 0xffffffff;

// visit(unsorted) for all own edge boxes in the order of polygon numbers: those that stand still, then the others.
template <typename Visit>
void visit_all(const raster::Polygons& polygons, const Visit& visit) {
  for (const auto& boxes : {polygons.stationary, polygons.moving})
    for (auto next = boxes.rbegin(); next != boxes.rend(); ++next) visit(*next);
}

}  // namespace

TriangleExchange::TriangleExchange(std::size_t nodes, std::size_t lines)
    : pending_(std::min(nodes, lines)), parcel_of_(lines) {
  parcels_.reserve(std::min(nodes, lines));
}

void TriangleExchange::send_triangles(const collectives::Group& group, const raster::Polygons& own,
                                      std::span<const geometry::LineRange> homes,
                                      std::span<const raster::LineLoad> line_loads, FrameMemory& memory) {
  const auto self = static_cast<std::size_t>(mynode() - group.first);
  if (memory.readers().size() + 1 == homes.size()) return;
  parcels_.clear();
  for (std::size_t i = 0; i < homes.size(); ++i) {
    const std::size_t home = (self + i) % homes.size();  // so that not all send to the same node first
    const int node = group.first + static_cast<int>(home);
    const auto on_home = [&](auto lines) { return lines.subspan(homes[home].first, homes[home].count()); };
    std::size_t boxes = 0;
    if (i > 0 && !memory.reads(node))
      for (const raster::LineLoad& load : on_home(line_loads)) boxes += load.boxes();
    const auto parcel = boxes > 0 ? static_cast<std::uint32_t>(parcels_.size()) : kNoParcel;
    std::ranges::fill(on_home(std::span(parcel_of_)), parcel);
    if (parcel == kNoParcel) continue;
    // It may hold one triangle an edge box, the most there can be.
    const auto message = memory.arena().take<std::byte>(triangles_at(boxes) + boxes * sizeof(geometry::Triangle));
    parcels_.push_back({node, message, reinterpret_cast<raster::UnsortedEdgeBox*>(message.data() + kBoxesAt) + boxes,
                        reinterpret_cast<geometry::Triangle*>(message.data() + triangles_at(boxes))});
    *reinterpret_cast<wire::TriangleHead*>(message.data()) = {boxes, 0};
  }
  fill_parcels(own);
  for (const Parcel& parcel : parcels_) {
    reinterpret_cast<wire::TriangleHead*>(parcel.message.data())->triangles = parcel.triangle_count;
    const auto* const end = reinterpret_cast<const std::byte*>(parcel.triangles + parcel.triangle_count);
    pending_.add(isend(wire::kTriangles, parcel.message.data(), end - parcel.message.data(), parcel.node, 0));
  }
}

// As a node has its own: triangles in order and numbered from 0, edge boxes from the last to the first.
void TriangleExchange::fill_parcels(const raster::Polygons& own) {
  if (parcels_.empty()) return;
  visit_all(own, [&](const raster::UnsortedEdgeBox& unsorted) {
    const std::uint32_t number = parcel_of_[unsorted.line];
    if (number == kNoParcel) return;
    Parcel& parcel = parcels_[number];
    if (std::exchange(parcel.last_triangle, unsorted.box.triangle) != unsorted.box.triangle)
      parcel.triangles[parcel.triangle_count++] = own.triangles[unsorted.box.triangle];
    raster::UnsortedEdgeBox& copy = *--parcel.next_box = unsorted;
    copy.box.triangle = static_cast<std::uint32_t>(parcel.triangle_count - 1);
  });
}

raster::Polygons TriangleExchange::receive_triangles(FrameMemory& memory, AwaitedTriangles& awaited) {
  cprobe(wire::kTriangles);
  const auto sender = static_cast<int>(infonode());
  const auto message = memory.arena().take<std::byte>(static_cast<std::size_t>(infocount()));
  crecv(wire::kTriangles, message.data(), static_cast<long>(message.size()));
  return read_triangles(message, awaited, sender);
}

void TriangleExchange::finish() { pending_.wait(); }

}  // namespace mars::group
