#include "node/exchange.h"

#include <algorithm>
#include <cstring>

#include "hal/failure.h"
#include "hal/nx.h"
#include "node/protocol.h"

namespace mars::node {
namespace {

// Ends a message of triangles: the first `stationary` of them stand still, the rest move.
struct Trailer {
  std::uint32_t stationary;
  std::uint32_t moving;
};

LineRange overlap(const LineRange& a, const LineRange& b) {
  const std::uint32_t first = std::max(a.first, b.first), last = std::min(a.last, b.last);
  return {first, std::max(first, last)};
}

// Copies those of triangles[first, first + count) that have an edge box on `home` to `out`; how many.
std::uint32_t select(std::span<const Triangle> triangles, const LineRange& home, std::int32_t width, Triangle* out) {
  std::uint32_t kept = 0;
  const auto at_home = [&](std::int32_t row) { return static_cast<std::uint32_t>(row) >= home.first; };
  for (const Triangle& triangle : triangles) {
    const Crossings crossings(triangle, width, static_cast<std::int32_t>(home.last));
    if (has_edge_box(crossings, at_home)) out[kept++] = triangle;
  }
  return kept;
}

Trailer select_both(const Polygons& own, const LineRange& home, std::int32_t width, Triangle* out) {
  const Polygons::Source& source = own.sources.front();
  Trailer kept{};
  kept.stationary = select(own.triangles.subspan(source.first, source.stationary), home, width, out);
  kept.moving = select(own.triangles.subspan(source.first + source.stationary, source.moving), home, width,
                       out + kept.stationary);
  return kept;
}

}  // namespace

Exchange::Exchange(int nodes) {
  pending_.reserve(2 * static_cast<std::size_t>(nodes));
  sources_.reserve(static_cast<std::size_t>(nodes));
}

Polygons Exchange::triangles(const hal::Cube& cube, const Polygons& own, std::span<const LineRange> homes,
                             std::int32_t width, std::uint64_t most_boxes, Arena& arena) {
  const int self = static_cast<int>(mynode()) - cube.first;
  for (int i = 1; i < cube.count; ++i) {
    const int index = (self + i) % cube.count;  // so that not all send to the same node first
    send_triangles(index, cube, own, homes[static_cast<std::size_t>(index)], width, arena);
  }
  const auto here = arena.take<Triangle>(most_boxes + 1);  // + 1: the trailer comes behind the last
  sources_.clear();
  const Trailer kept = select_both(own, homes[static_cast<std::size_t>(self)], width, here.data());
  sources_.push_back({0, kept.stationary, kept.moving});
  std::uint32_t count = kept.stationary + kept.moving;
  for (int i = 1; i < cube.count; ++i) {
    const int from = cube.first + (self + cube.count - i) % cube.count;
    crecv(triangles_from(from), here.data() + count, static_cast<long>((here.size() - count) * sizeof(Triangle)));
    const auto bytes = static_cast<std::size_t>(infocount()) - sizeof(Trailer);
    Trailer trailer;
    std::memcpy(&trailer, reinterpret_cast<const std::byte*>(here.data() + count) + bytes, sizeof trailer);
    sources_.push_back({count, trailer.stationary, trailer.moving});
    count += trailer.stationary + trailer.moving;
  }
  wait_all();
  return {here.first(count), sources_};
}

void Exchange::send_triangles(int index, const hal::Cube& cube, const Polygons& own, const LineRange& home,
                              std::int32_t width, Arena& arena) {
  const auto room = arena.rest<Triangle>();
  const Trailer kept = select_both(own, home, width, room.data());
  const std::uint32_t count = kept.stationary + kept.moving;
  std::memcpy(room.data() + count, &kept, sizeof kept);
  arena.take<Triangle>(count + 1);
  const std::size_t bytes = count * sizeof(Triangle) + sizeof kept;
  pending_.push_back(isend(triangles_from(mynode()), room.data(), static_cast<long>(bytes), cube.first + index, 0));
}

void Exchange::depth_lines(const hal::Cube& cube, std::span<const LineRange> homes, const LineRange& needed,
                           std::span<const std::uint8_t> draws, ZBuffer& buffer) {
  const int self = static_cast<int>(mynode()) - cube.first;
  const auto post = [&](int index, const auto& start) {
    const auto lines = overlap(homes[static_cast<std::size_t>(index)], needed);
    if (lines.count() == 0) return;
    const auto depth = buffer.depth(lines);
    pending_.push_back(start(depth.data(), static_cast<long>(depth.size_bytes())));
  };
  for (int i = 1; i < cube.count; ++i) {
    const int other = (self + i) % cube.count;
    if (draws[static_cast<std::size_t>(self)])
      post(other, [&](float* data, long bytes) { return irecv(depth_lines_from(cube.first + other), data, bytes); });
    if (draws[static_cast<std::size_t>(other)])
      post(self, [&](float* data, long bytes) {
        return isend(depth_lines_from(mynode()), data, bytes, cube.first + other, 0);
      });
  }
  wait_all();
}

void Exchange::wait_all() {
  for (const long mid : pending_) msgwait(mid);
  pending_.clear();
}

}  // namespace mars::node
