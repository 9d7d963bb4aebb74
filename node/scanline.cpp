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

std::size_t LineBoxes::stationary_lines() const {
  std::size_t count = 0;
  for (std::uint32_t line = lines.first; line < lines.last; ++line) count += !stationary(line).empty();
  return count;
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

ZBuffer::ZBuffer(const Kernels& kernels, std::int32_t width)
    : kernels_(kernels),
      width_(static_cast<std::size_t>(width)),
      depths_((width_ - 1) / kVectorSlack + 2),
      ids_(depths_.size()) {
  std::fill_n(ids(), ids_.size() * kVectorSlack, kNoTriangle);
}

void ZBuffer::draw_keyframe(const LineBoxes& boxes, const Shading& shading, const LineRange& kept, Czb& czb,
                            StripBuffer& out) {
  for (std::uint32_t line = boxes.lines.first; line < boxes.lines.last; ++line) {
    const auto stationary = boxes.stationary(line), moving = boxes.moving(line);
    if (stationary.empty() && moving.empty() && !kept.has(line)) continue;
    std::fill_n(depth(), width_, 0.0f);
    draw(stationary, shading, line, out.constant());
    if (kept.has(line)) std::copy_n(depth(), width_, czb.lines({line, line + 1}).data());
    // MZB starts as CZB: nearer than it is nearer than both, and of equals what stands still was there first.
    draw(moving, shading, line, out.moving());
  }
}

void ZBuffer::draw_inbetween(const LineBoxes& boxes, const Shading& shading, const LineRange& kept, Czb& czb,
                             StripBuffer& out) {
  for (std::uint32_t line = boxes.lines.first; line < boxes.lines.last; ++line) {
    const auto moving = boxes.moving(line);
    if (moving.empty()) continue;
    check(kept.has(line), "moving parts stay on the lines that were foreseen");
    std::uint32_t first = moving[0].first, last = moving[0].last;
    for (const EdgeBox& box : moving) first = std::min<std::uint32_t>(first, box.first), last = std::max<std::uint32_t>(last, box.last);
    std::copy_n(czb.lines({line, line + 1}).data() + first, last - first, depth() + first);
    draw(moving, shading, line, out.moving());
  }
}

// Draws the line's boxes, shades what their ids show and forgets these.
void ZBuffer::draw(std::span<const EdgeBox> boxes, const Shading& shading, std::uint32_t line, StripBuffer::Layer& out) {
  if (boxes.empty()) return;
  const Extent extent = kernels_.draw(shading.triangles, boxes.data(), static_cast<std::uint32_t>(boxes.size()), line,
                                      depth(), ids());
  out.added(kernels_.shade(shading, ids(), line, extent, out.next_run(), out.next_pixel()));
  std::fill(ids() + extent.first, ids() + extent.last, kNoTriangle);
}

}  // namespace mars::node
