// The inner loops: the same bits from every instruction set, and what they compute against plain loops in
// double precision.
#include "node/kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>

#include "hal/failure.h"
#include "node/bezier.h"
#include "tests/node/patches.h"

namespace mars::test {
namespace {

using node::EdgeBox;
using node::Extent;
using node::Kernels;

// All that this CPU runs, the narrowest first.
std::vector<const Kernels*> all_kernels() {
  std::vector<const Kernels*> all;
  for (const char* limit : {"sse2", "sse4", "avx2", "avx512"}) {
    const Kernels& kernels = node::best_kernels(limit);
    if (all.empty() || all.back() != &kernels) all.push_back(&kernels);
  }
  return all;
}

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

// Vertices in memory of their own; beyond `count` lie values that no kernel may touch.
struct VertexMemory {
  explicit VertexMemory(int count)
      : numbers(static_cast<std::size_t>(7 * (count + kGuard)), kUntouched),
        places(static_cast<std::size_t>(2 * (count + kGuard)), 77),
        flags(static_cast<std::size_t>(count + kGuard), 77),
        stride(count + kGuard) {}

  node::Vertices view() {
    float* n = numbers.data();
    return {{n, n + stride, n + 2 * stride},
            {n + 3 * stride, n + 4 * stride, n + 5 * stride},
            n + 6 * stride,
            places.data(),
            places.data() + stride,
            flags.data()};
  }
  bool operator==(const VertexMemory& other) const {
    return same_bits(numbers, other.numbers) && same_bits(places, other.places) &&
           same_bits(flags, other.flags);
  }

  static constexpr int kGuard = 20;
  static constexpr float kUntouched = 123;
  std::vector<float> numbers;
  std::vector<std::int32_t> places;
  std::vector<std::uint8_t> flags;
  int stride;
};

node::Row random_row(Random& random) {
  node::Row row{};
  for (auto& p : row.point)
    for (float& c : p) c = static_cast<float>(random.real(-5, 5));
  for (int k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis) row.slope[k][axis] = row.point[k + 1][axis] - row.point[k][axis];
  for (auto& p : row.cross)
    for (float& c : p) c = static_cast<float>(random.real(-1, 1));
  row.sign = random.whole(0, 1) ? 1 : -1;
  return row;
}

TEST(Kernels, AreChosenByName) {
  EXPECT_EQ(std::string_view(node::best_kernels("sse2").name), "sse2");
  EXPECT_EQ(&node::best_kernels(""), &node::best_kernels("avx512"));
  EXPECT_THROW(node::best_kernels("mmx"), Failure);
  if (all_kernels().size() < 2) GTEST_SKIP() << "this CPU has nothing wider than SSE2 to compare";
}

TEST(Kernels, EvaluateGivesTheSameBitsEverywhere) {
  Random random(50);
  for (int trial = 0; trial < 400; ++trial) {
    const int rate = random.whole(1, 70), first = random.whole(0, rate), last = random.whole(first, rate + 1);
    const int offset = random.whole(0, 5);
    node::Row row = random_row(random);
    if (trial % 7 == 0) std::memset(row.slope, 0, sizeof row.slope);
    std::vector<VertexMemory> results;
    for (const Kernels* kernels : all_kernels()) {
      VertexMemory memory(offset + last - first);
      kernels->evaluate(row, node::basis(rate), first, last, memory.view(), offset);
      EXPECT_EQ(memory.view().normal[2][offset + last - first], VertexMemory::kUntouched);
      results.push_back(memory);
      EXPECT_TRUE(memory == results[0]) << kernels->name << ", trial " << trial;
    }
  }
}

TEST(Kernels, EvaluateGivesPointsAndUnitNormals) {
  Random random(51);
  for (int trial = 0; trial < 200; ++trial) {
    const node::Row row = random_row(random);
    const int rate = random.whole(1, 40);
    VertexMemory memory(rate + 1);
    node::best_kernels("").evaluate(row, node::basis(rate), 0, rate + 1, memory.view(), 0);
    node::Curve curve{}, cross_curve{};
    std::memcpy(curve.point, row.point, sizeof curve.point);
    std::memcpy(cross_curve.point, row.cross, sizeof cross_curve.point);
    for (int k = 0; k <= rate; ++k) {
      const double t = static_cast<double>(k) / rate, s = 1 - t;
      Vec3 along{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        along[axis] =
            s * s * row.slope[0][axis] + 2 * s * t * row.slope[1][axis] + t * t * row.slope[2][axis];
      const Vec3 right = cross(along, point_at(cross_curve, t)), place = point_at(curve, t);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(memory.view().place[axis][k], place[axis], 1e-5);
        if (length(right) < 0.05) continue;
        EXPECT_NEAR(memory.view().normal[axis][k], row.sign * right[axis] / length(right), 1e-3);
      }
    }
  }
}

// Places before and behind the eye, near and far, inside and outside the guard band, and no places at all.
VertexMemory random_places(Random& random, int count) {
  VertexMemory memory(count);
  const node::Vertices v = memory.view();
  for (int k = 0; k < count; ++k) {
    const double size = std::pow(10, random.real(-3, 4));
    for (float* component : v.place) component[k] = static_cast<float>(random.real(-size, size));
    if (random.whole(0, 20) == 0) v.place[random.whole(0, 2)][k] = random.whole(0, 1) ? INFINITY : NAN;
    if (random.whole(0, 20) == 0) v.place[2][k] = 0;
  }
  return memory;
}

TEST(Kernels, ProjectGivesTheSameBitsEverywhere) {
  Random random(52);
  const node::Projection view = projection(639, 481, 2, 0.1, 500);
  for (int trial = 0; trial < 300; ++trial) {
    const int count = random.whole(0, 90);
    const VertexMemory places = random_places(random, count);
    std::vector<VertexMemory> results;
    for (const Kernels* kernels : all_kernels()) {
      results.push_back(places);
      kernels->project(view, results.back().view(), count);
      EXPECT_TRUE(results.back() == results[0]) << kernels->name << ", trial " << trial;
      EXPECT_EQ(results.back().flags[static_cast<std::size_t>(count)], 77);
    }
  }
}

TEST(Kernels, ProjectSnapsToTheNearestSubpixel) {
  Random random(53);
  const node::Projection view = projection(639, 481, 2, 0.1, 500);
  VertexMemory memory = random_places(random, 5000);
  node::best_kernels("").project(view, memory.view(), 5000);
  const node::Vertices v = memory.view();
  int inside = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vec3 place{v.place[0][k], v.place[1][k], v.place[2][k]};
    const double w = -place[2];
    const auto [x, y] = on_screen(view, place);
    const double dx = std::abs(x - view.center[0]) / view.guard,
                 dy = std::abs(y - view.center[1]) / view.guard;
    const bool at_border = std::abs(dx - 1) < 1e-5 || std::abs(dy - 1) < 1e-5;
    const bool expected = w >= view.near && w <= view.far && dx <= 1 && dy <= 1;
    EXPECT_TRUE(at_border || (v.outside[k] == 0) == expected) << k;
    if (v.outside[k]) continue;
    ++inside;
    EXPECT_NEAR(v.x[k] / 256.0, x, 0.5 / 256 + std::abs(x) * 4e-7 + 1e-4);
    EXPECT_NEAR(v.y[k] / 256.0, y, 0.5 / 256 + std::abs(y) * 4e-7 + 1e-4);
    EXPECT_NEAR(v.inverse_w[k] * w, 1, 2e-7);
  }
  EXPECT_GT(inside, 1000);
}

// Boxes of one line, some of them with the same plane, so that depths tie.
std::vector<EdgeBox> random_boxes(Random& random, std::int32_t width, int count) {
  std::vector<EdgeBox> boxes;
  for (int b = 0; b < count; ++b) {
    const std::int32_t first = random.whole(0, width - 1);
    EdgeBox box{static_cast<std::uint32_t>(1000 + b),
                static_cast<std::uint16_t>(first),
                static_cast<std::uint16_t>(random.whole(first + 1, width)),
                128,
                0,
                0};
    if (random.whole(0, 2)) {
      box.depth_at_x0 = static_cast<float>(random.whole(1, 3));
    } else {
      box.x0 = random.whole(-5000, 256 * width);
      box.depth_at_x0 = static_cast<float>(random.real(0, 4));
      box.depth_per_x = static_cast<float>(random.real(-1e-4, 1e-4));
    }
    boxes.push_back(box);
  }
  return boxes;
}

struct Line {
  explicit Line(std::int32_t width)
      : depth(static_cast<std::size_t>(width)), ids(depth.size(), node::kNoTriangle) {}
  std::vector<float> depth;
  std::vector<std::uint32_t> ids;
};

// Sample by sample, box by box; of equals the first stays.
void draw_plainly(const std::vector<EdgeBox>& boxes, Line& line) {
  for (const EdgeBox& box : boxes)
    for (std::int32_t column = box.first; column < box.last; ++column) {
      const auto at = static_cast<std::size_t>(column);
      const float depth = box.depth_at_x0 + static_cast<float>(256 * column + 128 - box.x0) * box.depth_per_x;
      if (!(depth > line.depth[at])) continue;
      line.depth[at] = depth;
      line.ids[at] = box.triangle;
    }
}

TEST(Kernels, DrawIsAPlainZBuffer) {
  Random random(54);
  for (int trial = 0; trial < 2000; ++trial) {
    const std::int32_t width = random.whole(1, 150);
    const auto boxes = random_boxes(random, width, random.whole(0, 12));
    Line plain(width);
    if (trial % 2)
      for (float& depth : plain.depth) depth = static_cast<float>(random.whole(0, 2));  // drawn before
    const Line before = plain;
    draw_plainly(boxes, plain);
    std::uint32_t first = 0xffffffff, last = 0;
    for (const EdgeBox& box : boxes) {
      first = std::min<std::uint32_t>(first, box.first);
      last = std::max<std::uint32_t>(last, box.last);
    }
    for (const Kernels* kernels : all_kernels()) {
      Line line = before;
      const auto count = static_cast<std::uint32_t>(boxes.size());
      const Extent extent = kernels->draw(boxes.data(), count, line.depth.data(), line.ids.data());
      EXPECT_TRUE(same_bits(line.depth, plain.depth) && line.ids == plain.ids)
          << kernels->name << ' ' << trial;
      EXPECT_EQ(extent.last, last);
      EXPECT_EQ(extent.first, first);
    }
  }
}

}  // namespace
}  // namespace mars::test
