#include "node/scanline.h"

#include <algorithm>

#include "hal/failure.h"

namespace mars::node {
namespace {

// Goes through the crossings of several senders in the order of patches; within a patch in the order of its
// dicing, for all triangles of a patch come from one sender.
class PatchOrder {
 public:
  // A sender's crossings [end, next) of one part, from the back.
  struct Head {
    const Crossing* next;
    const Crossing* end;
    std::uint32_t first_triangle;
  };

  PatchOrder(const Triangle* triangles, std::span<Head> heads) : triangles_(triangles), heads_(heads) {
    const auto empty = std::remove_if(heads_.begin(), heads_.end(), [](const Head& h) { return h.next == h.end; });
    heads_ = heads_.first(static_cast<std::size_t>(empty - heads_.begin()));
  }

  // visit(crossing, number of its triangle).
  template <typename Visit>
  void visit_all(const Visit& visit) {
    const auto later = [this](const Head& a, const Head& b) { return patch(a) > patch(b); };
    std::make_heap(heads_.begin(), heads_.end(), later);
    while (heads_.size() > 1) {
      std::pop_heap(heads_.begin(), heads_.end(), later);
      Head& head = heads_.back();
      const std::uint32_t first = patch(head);
      const Crossing* last = head.next - 1;
      while (last != head.end && patch({last, head.end, head.first_triangle}) == first) --last;
      visit_to(last, head, visit);
      if (head.next == head.end)
        heads_ = heads_.first(heads_.size() - 1);
      else
        std::push_heap(heads_.begin(), heads_.end(), later);
    }
    if (!heads_.empty()) visit_to(heads_[0].end, heads_[0], visit);
  }

 private:
  std::uint32_t patch(const Head& head) const {
    return triangles_[head.first_triangle + head.next[-1].box.triangle].patch;
  }
  template <typename Visit>
  static void visit_to(const Crossing* last, Head& head, const Visit& visit) {
    const std::uint32_t first_triangle = head.first_triangle;
    for (const Crossing* next = head.next; next != last;) {
      const Crossing crossing = *--next;
      visit(crossing, first_triangle + crossing.box.triangle);
    }
    head.next = last;
  }

  const Triangle* triangles_;
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
                     Arena& arena) {
  const std::uint64_t before = ebc[lines.first];
  const auto boxes = arena.take<EdgeBox>(ebc[lines.last] - before);
  const auto cursor = arena.take<std::uint64_t>(lines.count());
  const auto stationary_end = arena.take<std::uint64_t>(lines.count());
  for (std::size_t i = 0; i < cursor.size(); ++i) cursor[i] = ebc[lines.first + i] - before;

  const auto all_heads = arena.take<PatchOrder::Head>(polygons.sources.size());
  const auto place = [first = lines.first, count = lines.count(), next = cursor.data(), to = boxes.data()](
                         const Crossing& crossing, std::uint32_t triangle) {
    const std::uint32_t line = crossing.line - first;
    if (line < count) to[next[line]++] = {triangle, crossing.box.first, crossing.box.last};
  };
  const auto place_all = [&](auto part) {
    const auto heads = std::span(all_heads.data(), polygons.sources.size());
    std::transform(polygons.sources.begin(), polygons.sources.end(), heads.begin(), [&](const Polygons::Source& s) {
      const std::span<const Crossing> crossings = s.*part;
      return PatchOrder::Head{crossings.data() + crossings.size(), crossings.data(), s.first};
    });
    PatchOrder(polygons.triangles, heads).visit_all(place);
  };
  place_all(&Polygons::Source::stationary);
  std::copy(cursor.begin(), cursor.end(), stationary_end.begin());
  place_all(&Polygons::Source::moving);
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
    const Extent extent = kernels_.draw(shading.triangles, list.data(), static_cast<std::uint32_t>(list.size()), line,
                                        depth.data(), ids_.data());
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
        kernels_.draw(shading.triangles, list.data(), static_cast<std::uint32_t>(list.size()), line, moving_.data(),
                      ids_.data());
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
