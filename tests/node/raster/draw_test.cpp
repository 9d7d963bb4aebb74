// The drawing kernel: a plain z-buffer's bits from every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "node/raster/kernels.h"
#include "tests/node/shape/patches.h"
#include "tests/node/shape/sample_counts.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::raster {
namespace {

using geometry::Triangle;
using shading::Extent;

constexpr std::uint32_t kLine = 7;

// Boxes of one line, on any of its rows, in any order, most of them narrow, some of them with the same plane, so that
// depths tie.
struct Boxes {
  std::vector<Triangle> triangles;
  std::vector<EdgeBox> boxes;
};

Boxes random_boxes(shape::Random& random, std::int32_t width, std::int32_t samples, int count) {
  Boxes out;
  for (int b = 0; b < count; ++b) {
    const std::int32_t first = random.whole(0, width - 1);
    const std::int32_t widest = random.whole(0, 2) ? std::min(width, first + random.whole(1, 20)) : width;
    const std::int32_t last = random.whole(first + 1, widest);
    out.boxes.push_back({static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(first),
                         static_cast<std::uint32_t>(last - first - 1),
                         static_cast<std::uint32_t>(random.whole(0, samples - 1))});
    Triangle t{};
    t.first_x = 128;
    if (random.whole(0, 2)) {
      t.at_first[shape::kDepth] = static_cast<float>(random.whole(1, 3));
    } else {
      t.first_x = random.whole(-5000, 256 * width);
      t.first_y = random.whole(-5000, 5000);
      t.at_first[shape::kDepth] = static_cast<float>(random.real(0, 4));
      t.per_x[shape::kDepth] = static_cast<float>(random.real(-1e-4, 1e-4));
      t.per_y[shape::kDepth] = static_cast<float>(random.real(-1e-4, 1e-4));
    }
    t.patch = static_cast<std::uint32_t>(random.whole(0, 3));
    out.triangles.push_back(t);
  }
  for (std::size_t k = out.boxes.size(); k > 1; --k)
    std::swap(out.boxes[k - 1], out.boxes[static_cast<std::size_t>(random.whole(0, static_cast<std::int32_t>(k) - 1))]);
  return out;
}

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

// A line's rows, each with the slack behind it that kernels may use and leave as it was.
struct Line {
  Line(std::int32_t width, std::int32_t rows)
      : stride(static_cast<std::size_t>(width + simd::kVectorSlack)),
        depth(stride * static_cast<std::size_t>(rows), -9),
        ids(depth.size(), 99) {
    for (std::size_t row = 0; row < depth.size(); row += stride) {
      std::fill_n(depth.begin() + static_cast<std::ptrdiff_t>(row), width, 0.0f);
      std::fill_n(ids.begin() + static_cast<std::ptrdiff_t>(row), width, shading::kNoTriangle);
    }
  }
  LineSamples samples() { return {depth.data(), ids.data(), static_cast<std::uint32_t>(stride)}; }

  std::size_t stride;
  std::vector<float> depth;
  std::vector<std::uint32_t> ids;
};

// Sample by sample, box by box; of equals what was there before stays, else the lower patch's is seen, then the first.
void draw_plainly(const Boxes& boxes, const shape::SamplePattern& pattern, Line& line) {
  for (const EdgeBox& box : boxes.boxes)
    for (std::uint32_t column = box.first; column < box.last(); ++column) {
      const std::size_t at = box.sample * line.stride + column;
      const Triangle& t = boxes.triangles[box.triangle];
      const std::int32_t x = 256 * static_cast<std::int32_t>(column) + pattern.x[box.sample];
      const std::int32_t y = static_cast<std::int32_t>(256 * kLine) + pattern.y[box.sample];
      const float row = t.at_first[shape::kDepth] + static_cast<float>(y - t.first_y) * t.per_y[shape::kDepth];
      const float depth = row + static_cast<float>(x - t.first_x) * t.per_x[shape::kDepth];
      const std::uint32_t shown = line.ids[at];
      const bool first = shown != shading::kNoTriangle &&
                         std::pair(t.patch, box.triangle) < std::pair(boxes.triangles[shown].patch, shown);
      if (!(depth > line.depth[at] || (depth == line.depth[at] && first))) continue;
      line.depth[at] = depth;
      line.ids[at] = box.triangle;
    }
}

TEST(Draw, IsAPlainZBuffer) {
  shape::Random random(54);
  for (std::size_t trial = 0; trial < 2000; ++trial) {
    const std::int32_t width = random.whole(1, 150);
    const shape::SamplePattern& pattern = shape::sample_pattern(shape::kSampleCounts[trial % 5]);
    const auto boxes = random_boxes(random, width, pattern.count, random.whole(0, 100));
    Line plain(width, pattern.count);
    if (trial % 2)  // drawn before
      for (float& depth : plain.depth)
        if (depth == 0) depth = static_cast<float>(random.whole(0, 2));
    const Line before = plain;
    draw_plainly(boxes, pattern, plain);
    std::uint32_t first = 0xffffffff, last = 0;
    for (const EdgeBox& box : boxes.boxes) {
      first = std::min<std::uint32_t>(first, box.first);
      last = std::max<std::uint32_t>(last, box.last());
    }
    for (const simd::InstructionSet set : simd::all_sets()) {
      Line line = before;
      const auto count = static_cast<std::uint32_t>(boxes.boxes.size());
      const Extent extent =
          raster_kernels(set).draw(boxes.triangles.data(), boxes.boxes.data(), count, kLine, pattern, line.samples());
      EXPECT_TRUE(same_bits(line.depth, plain.depth) && line.ids == plain.ids) << simd::name_of(set) << ' ' << trial;
      EXPECT_EQ(extent.last, last);
      EXPECT_EQ(extent.first, first);
    }
  }
}

}  // namespace
}  // namespace mars::raster
