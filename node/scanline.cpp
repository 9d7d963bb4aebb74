#include "node/scanline.h"

#include <algorithm>

#include "hal/failure.h"

namespace mars::node {
namespace {

// Goes through the triangles of several senders in the order of patches; within a patch in the order of its
// dicing, for all triangles of a patch come from one sender.
class PatchOrder {
 public:
  // [next, end) of every sender's triangles of one part.
  struct Head {
    std::uint32_t next;
    std::uint32_t end;
  };

  PatchOrder(std::span<const Triangle> triangles, std::span<Head> heads) : triangles_(triangles), heads_(heads) {
    const auto empty = std::remove_if(heads_.begin(), heads_.end(), [](const Head& h) { return h.next == h.end; });
    heads_ = heads_.first(static_cast<std::size_t>(empty - heads_.begin()));
  }

  template <typename Visit>
  void visit_all(const Visit& visit) {
    const auto later = [this](const Head& a, const Head& b) {
      return triangles_[a.next].patch > triangles_[b.next].patch;
    };
    std::make_heap(heads_.begin(), heads_.end(), later);
    while (!heads_.empty()) {
      std::pop_heap(heads_.begin(), heads_.end(), later);
      Head& head = heads_.back();
      const std::uint32_t patch = triangles_[head.next].patch;
      while (head.next != head.end && triangles_[head.next].patch == patch) visit(head.next++);
      if (head.next == head.end)
        heads_ = heads_.first(heads_.size() - 1);
      else
        std::push_heap(heads_.begin(), heads_.end(), later);
    }
  }

 private:
  std::span<const Triangle> triangles_;
  std::span<Head> heads_;
};

}  // namespace

std::span<const EdgeBox> LineBoxes::stationary(std::uint32_t line) const {
  const std::size_t i = line - lines.first;
  const std::uint64_t begin = i == 0 ? 0 : end[i - 1];
  return boxes.subspan(begin, stationary_end[i] - begin);
}

std::span<const EdgeBox> LineBoxes::moving(std::uint32_t line) const {
  const std::size_t i = line - lines.first;
  return boxes.subspan(stationary_end[i], end[i] - stationary_end[i]);
}

LineBoxes fill_lines(const Polygons& polygons, const LineRange& lines, std::span<const std::uint64_t> ebc,
                     std::int32_t width, Arena& arena) {
  const std::uint64_t before = ebc[lines.first];
  const auto boxes = arena.take<EdgeBox>(ebc[lines.last] - before);
  const auto cursor = arena.take<std::uint64_t>(lines.count());
  const auto stationary_end = arena.take<std::uint64_t>(lines.count());
  const auto heads = arena.take<PatchOrder::Head>(polygons.sources.size());
  for (std::size_t i = 0; i < cursor.size(); ++i) cursor[i] = ebc[lines.first + i] - before;

  const auto place = [&](std::uint32_t number) {
    place_edge_boxes(polygons.triangles[number], number, width, lines, cursor, boxes);
  };
  const auto place_all = [&](auto head_of) {
    std::transform(polygons.sources.begin(), polygons.sources.end(), heads.begin(), head_of);
    PatchOrder(polygons.triangles, heads).visit_all(place);
  };
  place_all([](const Polygons::Source& s) { return PatchOrder::Head{s.first, s.first + s.stationary}; });
  std::copy(cursor.begin(), cursor.end(), stationary_end.begin());
  place_all([](const Polygons::Source& s) {
    return PatchOrder::Head{s.first + s.stationary, s.first + s.stationary + s.moving};
  });
  for (std::size_t i = 0; i < cursor.size(); ++i)
    check(cursor[i] == ebc[lines.first + i + 1] - before, "the edge boxes of a line are those EBC counted");
  return {lines, boxes, cursor, stationary_end};
}

ZBuffer::ZBuffer(const Kernels& kernels, std::int32_t width, std::int32_t height)
    : kernels_(kernels),
      width_(static_cast<std::size_t>(width)),
      constant_(width_ * static_cast<std::size_t>(height)),
      moving_(width_),
      ids_(width_, kNoTriangle) {}

void ZBuffer::draw_stationary(const LineBoxes& boxes, const Shading& shading, StripBuffer& out) {
  for (std::uint32_t line = boxes.lines.first; line < boxes.lines.last; ++line) {
    const auto depth = this->depth({line, line + 1});
    std::fill(depth.begin(), depth.end(), 0.0f);
    const auto list = boxes.stationary(line);
    if (list.empty()) continue;
    const Extent extent = kernels_.draw(list.data(), static_cast<std::uint32_t>(list.size()), depth.data(), ids_.data());
    shade_line(shading, line, extent, out);
  }
}

void ZBuffer::draw_moving(const LineBoxes& boxes, const Shading& shading, StripBuffer& out) {
  for (std::uint32_t line = boxes.lines.first; line < boxes.lines.last; ++line) {
    const auto list = boxes.moving(line);
    if (list.empty()) continue;
    // MZB starts as CZB: nearer than it is nearer than both, and of equals what stands still was there first.
    const auto depth = this->depth({line, line + 1});
    std::copy(depth.begin(), depth.end(), moving_.begin());
    const Extent extent =
        kernels_.draw(list.data(), static_cast<std::uint32_t>(list.size()), moving_.data(), ids_.data());
    shade_line(shading, line, extent, out);
  }
}

std::span<float> ZBuffer::depth(const LineRange& lines) {
  return std::span(constant_).subspan(lines.first * width_, lines.count() * width_);
}

// Shades what the line's ids show and forgets them.
void ZBuffer::shade_line(const Shading& shading, std::uint32_t line, Extent extent, StripBuffer& out) {
  out.added(kernels_.shade(shading, ids_.data(), line, extent, out.next_run(), out.next_pixel()));
  std::fill(ids_.begin() + extent.first, ids_.begin() + extent.last, kNoTriangle);
}

}  // namespace mars::node
