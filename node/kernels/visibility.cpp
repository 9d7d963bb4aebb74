// Which triangle a line's samples show.
#include "node/kernels/simd.h"

namespace mars::node::MARS_SET {
namespace {

// Boxes ahead whose triangles are fetched: they come from all over memory.
constexpr std::uint32_t kAhead = 32;

// Narrower boxes are drawn sample by sample, wider ones by vectors, but not by the widest: a vector waits until what
// a neighbouring box stored of its samples has reached the cache.
constexpr int kWide = 3;
using Narrow = hn::CappedTag<float, 1>;
using Wide = hn::CappedTag<float, 8>;

// A triangle's depth along a line: on_line + dx * per_x, dx in 1/256 pixel.
struct Depth {
  float on_line;
  float per_x;
};

// Draws `count` samples, the first at dx, as many at once as `floats` has lanes.
template <typename Tag>
void draw_samples(Tag floats, const Depth& plane, float dx, int count, std::uint32_t triangle, float* depth,
                  std::uint32_t* ids) {
  const hn::Rebind<std::uint32_t, Tag> numbers;
  constexpr int kStep = static_cast<int>(hn::MaxLanes(Tag()));
  const auto on_line = hn::Set(floats, plane.on_line), per_x = hn::Set(floats, plane.per_x);
  auto along = hn::Add(hn::Set(floats, dx), hn::Mul(hn::Iota(floats, 0.0f), hn::Set(floats, kSubpixels)));
  for (int k = 0; k < count; k += kStep) {
    const auto here = hn::Add(on_line, hn::Mul(along, per_x));
    const auto there = hn::LoadU(floats, depth + k);
    auto nearer = hn::Gt(here, there);
    if constexpr (kStep > 1) nearer = hn::And(nearer, hn::FirstN(floats, static_cast<std::size_t>(count - k)));
    hn::StoreU(hn::IfThenElse(nearer, here, there), floats, depth + k);
    const auto shown = hn::LoadU(numbers, ids + k);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(numbers, nearer), hn::Set(numbers, triangle), shown), numbers, ids + k);
    along = hn::Add(along, hn::Set(floats, static_cast<float>(kStep) * kSubpixels));
  }
}

}  // namespace

Extent draw(const Triangle* triangles, const EdgeBox* boxes, std::uint32_t count, std::uint32_t line,
            float* __restrict depth, std::uint32_t* __restrict ids) {
  Extent extent{0xffffffffu, 0};
  const std::int32_t y = static_cast<std::int32_t>(line) * kSubpixels + kSampleOffset;
  for (std::uint32_t b = 0; b < count; ++b) {
    __builtin_prefetch(triangles + boxes[b + kAhead < count ? b + kAhead : b].triangle);
    const EdgeBox box = boxes[b];
    const Triangle& t = triangles[box.triangle];
    extent.first = box.first < extent.first ? box.first : extent.first;
    extent.last = box.last > extent.last ? box.last : extent.last;
    const auto dy = static_cast<float>(y - t.first_y);
    const auto dx = static_cast<float>(box.first * kSubpixels + kSampleOffset - t.first_x);
    const Depth plane{t.at_first[kDepth] + dy * t.per_y[kDepth], t.per_x[kDepth]};
    const int width = box.last - box.first;
    if (width < kWide)
      draw_samples(Narrow(), plane, dx, width, box.triangle, depth + box.first, ids + box.first);
    else
      draw_samples(Wide(), plane, dx, width, box.triangle, depth + box.first, ids + box.first);
  }
  return extent;
}

}  // namespace mars::node::MARS_SET
