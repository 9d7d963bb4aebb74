// The triangle that each sample of a line shows.
#include <cstddef>
#include <cstdint>

#include "node/raster/kernels/functions.h"

namespace mars::raster::MARS_SET {

using namespace simd::MARS_SET;

namespace {

// Boxes ahead, for each sample of a pixel, whose triangles are fetched: they come from all over memory.
constexpr std::uint32_t kAhead = 32;

// Boxes of one sample, the most frequent, are drawn alone, others by vectors, but not by the widest: a vector waits
// until what a neighbouring box stored of its samples has reached the cache.
using Narrow = hn::CappedTag<float, 1>;
using Wide = hn::CappedTag<float, 8>;

// Whether triangle a is the one seen where both are as near: the lower patch's, then the first within it. None is what
// was there before.
bool precedes(const geometry::Triangle* triangles, std::uint32_t a, std::uint32_t b) {
  if (b == shading::kNoTriangle) return false;
  const std::uint32_t patch_a = triangles[a].patch, patch_b = triangles[b].patch;
  return patch_a != patch_b ? patch_a < patch_b : a < b;
}

// A triangle's depth along a line: on_line + dx * per_x, dx in 1/256 pixel.
struct Depth {
  float on_line;
  float per_x;
};

// `triangle` takes over those of the samples marked by `tied` that it precedes.
template <typename Tag>
[[gnu::noinline]] void settle(Tag floats, hn::Mask<Tag> tied, const geometry::Triangle* triangles,
                              std::uint32_t triangle, std::uint32_t* ids) {
  constexpr int kStep = static_cast<int>(hn::MaxLanes(Tag()));
  float marks[kStep];
  hn::StoreU(hn::IfThenElseZero(tied, hn::Set(floats, 1.0f)), floats, marks);
  for (int k = 0; k < kStep; ++k)
    if (marks[k] != 0 && precedes(triangles, triangle, ids[k])) ids[k] = triangle;
}

// Draws `count` samples, the first at dx, as many at once as `floats` has lanes.
template <typename Tag>
void draw_samples(Tag floats, const Depth& plane, float dx, int count, const geometry::Triangle* triangles,
                  std::uint32_t triangle, float* __restrict depth, std::uint32_t* __restrict ids) {
  const hn::Rebind<std::uint32_t, Tag> numbers;
  constexpr int kStep = static_cast<int>(hn::MaxLanes(Tag()));
  const auto on_line = hn::Set(floats, plane.on_line), per_x = hn::Set(floats, plane.per_x);
  auto along = hn::Add(hn::Set(floats, dx), hn::Mul(hn::Iota(floats, 0.0f), hn::Set(floats, shape::kSubpixels)));
  for (int k = 0; k < count; k += kStep) {
    const auto here = hn::Add(on_line, hn::Mul(along, per_x));
    const auto there = hn::LoadU(floats, depth + k);
    auto nearer = hn::Gt(here, there), tied = hn::Eq(here, there);
    if constexpr (kStep > 1) {
      const auto within = hn::FirstN(floats, static_cast<std::size_t>(count - k));
      nearer = hn::And(nearer, within);
      tied = hn::And(tied, within);
    }
    hn::StoreU(hn::IfThenElse(nearer, here, there), floats, depth + k);
    const auto shown = hn::LoadU(numbers, ids + k);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(numbers, nearer), hn::Set(numbers, triangle), shown), numbers, ids + k);
    if (!hn::AllFalse(floats, tied)) settle(floats, tied, triangles, triangle, ids + k);
    along = hn::Add(along, hn::Set(floats, static_cast<float>(kStep) * shape::kSubpixels));
  }
}

}  // namespace

shading::Extent draw(const geometry::Triangle* triangles, const EdgeBox* boxes, std::uint32_t count, std::uint32_t line,
                     const shape::SamplePattern& pattern, const LineSamples& samples) {
  shading::Extent extent{0xffffffffu, 0};
  const std::int32_t top = static_cast<std::int32_t>(line) * shape::kSubpixels;
  const std::uint32_t ahead = kAhead * static_cast<std::uint32_t>(pattern.count);
  for (std::uint32_t b = 0; b < count; ++b) {
    __builtin_prefetch(triangles + boxes[b + ahead < count ? b + ahead : b].triangle);
    const EdgeBox box = boxes[b];
    const geometry::Triangle& t = triangles[box.triangle];
    extent.first = box.first < extent.first ? box.first : extent.first;
    extent.last = box.last() > extent.last ? box.last() : extent.last;
    const auto dy = static_cast<float>(top + pattern.y[box.sample] - t.first_y);
    const auto dx = static_cast<float>(static_cast<std::int32_t>(box.first) * shape::kSubpixels +
                                       pattern.x[box.sample] - t.first_x);
    const Depth plane{t.at_first[shape::kDepth] + dy * t.per_y[shape::kDepth], t.per_x[shape::kDepth]};
    const auto width = static_cast<int>(box.width());
    const std::uint32_t at = box.sample * samples.stride + box.first;
    if (width == 1)
      draw_samples(Narrow(), plane, dx, width, triangles, box.triangle, samples.depth + at, samples.ids + at);
    else
      draw_samples(Wide(), plane, dx, width, triangles, box.triangle, samples.depth + at, samples.ids + at);
  }
  return extent;
}

}  // namespace mars::raster::MARS_SET
