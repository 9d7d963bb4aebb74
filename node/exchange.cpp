#include "node/exchange.h"

#include <algorithm>

#include "hal/failure.h"
#include "hal/nx.h"
#include "node/protocol.h"

namespace mars::node {
namespace {

LineRange overlap(const LineRange& a, const LineRange& b) {
  const std::uint32_t first = std::max(a.first, b.first), last = std::min(a.last, b.last);
  return {first, std::max(first, last)};
}

// Copies crossings on `home`, from the last to the first, to the end of a piece of memory and their triangles to its
// front, numbered anew: in memory as a node has its own.
class Selection {
 public:
  Selection(std::span<std::byte> room)
      : triangles_(reinterpret_cast<Triangle*>(room.data())),
        end_(reinterpret_cast<Crossing*>(room.data() + room.size())),
        crossing_(end_) {}

  void add(const Triangle* triangles, std::span<const Crossing> crossings, const LineRange& home) {
    std::uint32_t copied = kNoTriangle;  // the triangle copied last
    for (auto next = crossings.rbegin(); next != crossings.rend(); ++next) {
      if (next->line < home.first || next->line >= home.last) continue;
      if (next->box.triangle != copied) {
        copied = next->box.triangle;
        triangles_[count_++] = triangles[copied];
      }
      *--crossing_ = *next;
      crossing_->box.triangle = static_cast<std::uint32_t>(count_ - 1);
    }
  }

  std::span<const Triangle> triangles() const { return {triangles_, count_}; }
  std::span<const Crossing> crossings() const { return {crossing_, static_cast<std::size_t>(end_ - crossing_)}; }

 private:
  Triangle* triangles_;
  Crossing* end_;
  Crossing* crossing_;
  std::size_t count_ = 0;
};

template <typename T>
long bytes_of(std::span<const T> items) {
  return static_cast<long>(items.size_bytes());
}

}  // namespace

Exchange::Exchange(int nodes) {
  pending_.reserve(4 * static_cast<std::size_t>(nodes));
}

void Exchange::send_triangles(const hal::Cube& cube, const Polygons& own, std::span<const LineRange> homes,
                              Arena& arena) {
  const int self = static_cast<int>(mynode()) - cube.first;
  for (int i = 1; i < cube.count; ++i) {
    const int index = (self + i) % cube.count;  // so that not all send to the same node first
    send_triangles_to(cube.first + index, own, homes[static_cast<std::size_t>(index)], arena);
  }
}

void Exchange::send_triangles_to(int node, const Polygons& own, const LineRange& home, Arena& arena) {
  Selection selection(arena.rest());
  selection.add(own.triangles, own.stationary, home);
  selection.add(own.triangles, own.moving, home);
  const auto triangles = selection.triangles();
  const auto crossings = selection.crossings();
  arena.keep(triangles.size_bytes(), crossings.size_bytes());
  pending_.push_back(isend(triangles_from(mynode()), triangles.data(), bytes_of(triangles), node, 0));
  pending_.push_back(isend(crossings_from(mynode()), crossings.data(), bytes_of(crossings), node, 0));
}

Polygons Exchange::receive_triangles(const hal::Cube& cube, int number, Arena& arena) {
  const int self = static_cast<int>(mynode()) - cube.first;
  const int node = cube.first + (self + cube.count - number) % cube.count;
  cprobe(triangles_from(node));
  const auto triangles = arena.take<Triangle>(static_cast<std::size_t>(infocount()) / sizeof(Triangle));
  crecv(triangles_from(node), triangles.data(), bytes_of(std::span<const Triangle>(triangles)));
  cprobe(crossings_from(node));
  const auto crossings = arena.take<Crossing>(static_cast<std::size_t>(infocount()) / sizeof(Crossing));
  crecv(crossings_from(node), crossings.data(), bytes_of(std::span<const Crossing>(crossings)));
  const auto stationary =
      std::partition_point(crossings.begin(), crossings.end(), [](const Crossing& c) { return c.moving == 1; });
  const auto moving = static_cast<std::size_t>(stationary - crossings.begin());
  return {triangles.data(), crossings.subspan(moving), crossings.first(moving)};
}

// A machine's first node of the cube, its head, collects what the others write or send there, then tells all who wait.
void Exchange::depth_lines(const hal::Cube& cube, std::span<const LineRange> homes, const LineRange& needed,
                           std::span<const std::uint8_t> draws, Czb& czb) {
  const auto self = static_cast<int>(mynode());
  const int head = czb.head_of(self);
  const auto drawn_at = [&](int node) { return draws[static_cast<std::size_t>(node - cube.first)] == 1; };
  const auto drawn_under = [&](int other_head) {
    for (int node = other_head; node < cube.first + cube.count; ++node)
      if (drawn_at(node) && czb.head_of(node) == other_head) return true;
    return false;
  };
  const LineRange own = overlap(homes[static_cast<std::size_t>(self - cube.first)], needed);
  for (int to = cube.first; to < cube.first + cube.count; ++to) {
    if (to == self || czb.head_of(to) != to || own.count() == 0 || !drawn_under(to)) continue;
    const auto lines = czb.lines(to == head ? LineRange{} : own);
    pending_.push_back(isend(depth_lines_from(self), lines.data(), bytes_of(std::span<const float>(lines)), to, 0));
  }
  if (self == head && drawn_under(self)) {
    collect_depth(cube, homes, needed, czb);
    for (int node = cube.first; node < cube.first + cube.count; ++node)
      if (node != self && drawn_at(node) && czb.head_of(node) == self) csend(depth_lines_from(self), nullptr, 0, node, 0);
  } else if (drawn_at(self)) {
    crecv(depth_lines_from(head), nullptr, 0);
  }
  finish();
}

void Exchange::collect_depth(const hal::Cube& cube, std::span<const LineRange> homes, const LineRange& needed, Czb& czb) {
  const auto self = static_cast<int>(mynode());
  for (int from = cube.first; from < cube.first + cube.count; ++from) {
    const LineRange lines = overlap(homes[static_cast<std::size_t>(from - cube.first)], needed);
    if (from == self || lines.count() == 0) continue;
    const auto depth = czb.lines(czb.head_of(from) == self ? LineRange{} : lines);
    pending_.push_back(irecv(depth_lines_from(from), depth.data(), static_cast<long>(depth.size_bytes())));
  }
  finish();
}

void Exchange::finish() {
  for (const long mid : pending_) msgwait(mid);
  pending_.clear();
}

}  // namespace mars::node
