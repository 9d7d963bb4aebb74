// The inner loops of shape: the same bits from every instruction set, and what they compute against plain loops in
// double precision.
#include "node/shape/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "node/shape/bezier.h"
#include "tests/node/shape/patches.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::shape {
namespace {

// Bits of all kinds: NaNs, infinities, numbers.
float garbage(Random& random) { return std::bit_cast<float>(random.bits()); }

// Vertices in memory of their own, with the slack that kernels may write and guards that they may not.
struct VertexMemory {
  explicit VertexMemory(int count)
      : count(count),
        stride(static_cast<std::size_t>(count + simd::kVectorSlack + kGuard)),
        numbers(10 * stride, kUntouched),
        places(2 * stride, 77),
        flags(stride, 77) {}

  Vertices view() {
    float* n = numbers.data();
    return {{n, n + stride, n + 2 * stride},
            {n + 3 * stride, n + 4 * stride, n + 5 * stride},
            reinterpret_cast<float(*)[kValues]>(n + 6 * stride),
            places.data(),
            places.data() + stride,
            flags.data()};
  }
  void litter(Random& random) {
    for (int k = count; k < count + simd::kVectorSlack; ++k) {
      const auto at = static_cast<std::size_t>(k);
      for (std::size_t array = 0; array < 6; ++array) numbers[array * stride + at] = garbage(random);
      for (std::size_t value = 0; value < 4; ++value) numbers[6 * stride + 4 * at + value] = garbage(random);
    }
  }
  // Whether all before the slack is the same bits.
  bool same(const VertexMemory& other) const {
    const auto counted = static_cast<std::size_t>(count);
    bool equal = true;
    for (std::size_t array = 0; array < 6; ++array) equal &= same_bits(numbers, other.numbers, array * stride, counted);
    return equal && same_bits(numbers, other.numbers, 6 * stride, 4 * counted) &&
           same_bits(places, other.places, 0, counted) && same_bits(places, other.places, stride, counted) &&
           same_bits(flags, other.flags, 0, counted);
  }
  bool guards_intact() const {
    const std::size_t end = stride - kGuard;
    bool intact = true;
    for (std::size_t k = end; k < stride; ++k) {
      for (std::size_t array = 0; array < 6; ++array) intact &= numbers[array * stride + k] == kUntouched;
      for (std::size_t value = 0; value < 4; ++value) intact &= numbers[6 * stride + 4 * k + value] == kUntouched;
      intact &= places[k] == 77 && places[stride + k] == 77 && flags[k] == 77;
    }
    return intact;
  }

  static constexpr std::size_t kGuard = 20;
  static constexpr float kUntouched = 123;
  int count;
  std::size_t stride;
  std::vector<float> numbers;
  std::vector<std::int32_t> places;
  std::vector<std::uint8_t> flags;

 private:
  template <typename T>
  static bool same_bits(const std::vector<T>& a, const std::vector<T>& b, std::size_t first, std::size_t count) {
    return std::memcmp(a.data() + first, b.data() + first, count * sizeof(T)) == 0;
  }
};

// Whether any of vertices [first, last) has the normal 0.
bool lacks_normals(VertexMemory& memory, int first, int last) {
  const Vertices v = memory.view();
  for (int k = first; k < last; ++k)
    if (v.normal[0][k] == 0 && v.normal[1][k] == 0 && v.normal[2][k] == 0) return true;
  return false;
}

Row random_row(Random& random) {
  Row row{};
  for (auto& p : row.point)
    for (float& c : p) c = static_cast<float>(random.real(-5, 5));
  for (int k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis) row.slope[k][axis] = row.point[k + 1][axis] - row.point[k][axis];
  for (auto& p : row.cross)
    for (float& c : p) c = static_cast<float>(random.real(-1, 1));
  row.sign = random.whole(0, 1) ? 1 : -1;
  return row;
}

// Tables of a basis of their own, with garbage in their slack.
struct LitteredBasis {
  LitteredBasis(int rate, Random& random) {
    basis.rate = rate;
    const auto copy = [&](const float* table, std::vector<float>& own) {
      own.assign(table, table + rate + 1);
      while (own.size() < static_cast<std::size_t>(rate + 1 + simd::kVectorSlack)) own.push_back(garbage(random));
      return own.data();
    };
    for (int k = 0; k < 4; ++k) basis.cubic[k] = copy(shape::basis(rate).cubic[k], numbers[k]);
    for (int k = 0; k < 3; ++k) basis.quadratic[k] = copy(shape::basis(rate).quadratic[k], numbers[4 + k]);
  }
  std::vector<float> numbers[7];
  Basis basis;
};

// With normals, without any, and without those at the ends only.
TEST(ShapeKernels, EvaluateGivesTheSameBitsEverywhere) {
  Random random(50);
  int complete = 0, incomplete = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const int rate = random.whole(1, 70), first = random.whole(0, rate), last = random.whole(first, rate + 1);
    const int offset = random.whole(0, 5);
    Row row = random_row(random);
    if (trial % 7 == 0) std::memset(row.slope, 0, sizeof row.slope);
    if (trial % 7 == 1) std::memset(row.slope[2 * random.whole(0, 1)], 0, sizeof row.slope[0]);
    const LitteredBasis littered(rate, random);
    std::vector<VertexMemory> results;
    for (const simd::InstructionSet set : simd::all_sets())
      for (const Basis& basis : {shape::basis(rate), littered.basis}) {
        VertexMemory memory(offset + last - first);
        const bool all = shape_kernels(set).evaluate(row, basis, first, last, memory.view(), offset);
        results.push_back(memory);
        EXPECT_TRUE(memory.guards_intact()) << simd::name_of(set) << ", trial " << trial;
        EXPECT_TRUE(memory.same(results[0])) << simd::name_of(set) << ", trial " << trial;
        for (int k = 0; k < offset; ++k) EXPECT_EQ(memory.view().place[0][k], VertexMemory::kUntouched);
        EXPECT_EQ(all, !lacks_normals(memory, offset, offset + last - first))
            << simd::name_of(set) << ", trial " << trial;
        if (results.size() == 1) (all ? complete : incomplete) += last > first;
      }
  }
  EXPECT_GT(complete, 70);
  EXPECT_GT(incomplete, 70);
}

TEST(ShapeKernels, EvaluateGivesPointsAndUnitNormals) {
  Random random(51);
  for (int trial = 0; trial < 200; ++trial) {
    const Row row = random_row(random);
    const int rate = random.whole(1, 40);
    VertexMemory memory(rate + 1);
    shape_kernels(simd::best_instruction_set("")).evaluate(row, shape::basis(rate), 0, rate + 1, memory.view(), 0);
    Curve curve{}, cross_curve{};
    std::memcpy(curve.point, row.point, sizeof curve.point);
    std::memcpy(cross_curve.point, row.cross, sizeof cross_curve.point);
    for (int k = 0; k <= rate; ++k) {
      const double t = static_cast<double>(k) / rate, s = 1 - t;
      Vec3 along{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        along[axis] = s * s * row.slope[0][axis] + 2 * s * t * row.slope[1][axis] + t * t * row.slope[2][axis];
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
  const Vertices v = memory.view();
  for (int k = 0; k < count; ++k) {
    const double size = std::pow(10, random.real(-3, 4));
    for (float* component : v.place) component[k] = static_cast<float>(random.real(-size, size));
    if (random.whole(0, 20) == 0) v.place[random.whole(0, 2)][k] = random.whole(0, 1) ? INFINITY : NAN;
    if (random.whole(0, 20) == 0) v.place[2][k] = 0;
  }
  return memory;
}

TEST(ShapeKernels, ProjectGivesTheSameBitsEverywhere) {
  Random random(52);
  const Projection view = projection(639, 481, 2, 0.1, 500);
  int any = 0, none = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int count = random.whole(0, 90);
    VertexMemory places = random_places(random, count);
    if (trial % 2)  // all in view
      for (int k = 0; k < count; ++k) {
        for (int axis = 0; axis < 2; ++axis) places.view().place[axis][k] = static_cast<float>(random.real(-1, 1));
        places.view().place[2][k] = static_cast<float>(random.real(-9, -0.2));
      }
    std::vector<VertexMemory> results;
    std::vector<bool> reaches;
    for (const simd::InstructionSet set : simd::all_sets())
      for (const bool littered : {false, true}) {
        VertexMemory memory = places;
        if (littered) memory.litter(random);
        reaches.push_back(shape_kernels(set).project(view, memory.view(), count));
        results.push_back(memory);
        EXPECT_TRUE(memory.guards_intact()) << simd::name_of(set) << ", trial " << trial;
        EXPECT_TRUE(memory.same(results[0])) << simd::name_of(set) << ", trial " << trial;
        EXPECT_EQ(reaches.back(), std::count(memory.flags.begin(), memory.flags.begin() + count, 1) > 0);
      }
    any += reaches[0];
    none += !reaches[0] && count > 0;
  }
  EXPECT_GT(any, 50);
  EXPECT_GT(none, 50);
}

TEST(ShapeKernels, ProjectSnapsToTheNearestSubpixel) {
  Random random(53);
  const Projection view = projection(639, 481, 2, 0.1, 500);
  VertexMemory memory = random_places(random, 5000);
  shape_kernels(simd::best_instruction_set("")).project(view, memory.view(), 5000);
  const Vertices v = memory.view();
  int inside = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vec3 place{v.place[0][k], v.place[1][k], v.place[2][k]};
    const double w = -place[2];
    const auto [x, y] = on_screen(view, place);
    const double dx = std::abs(x - view.center[0]) / view.guard, dy = std::abs(y - view.center[1]) / view.guard;
    const bool at_border = std::abs(dx - 1) < 1e-5 || std::abs(dy - 1) < 1e-5;
    const bool expected = w >= view.near && w <= view.far && dx <= 1 && dy <= 1;
    EXPECT_TRUE(at_border || (v.outside[k] == 0) == expected) << k;
    if (v.outside[k]) continue;
    ++inside;
    EXPECT_NEAR(v.x[k] / 256.0, x, 0.5 / 256 + std::abs(x) * 4e-7 + 1e-4);
    EXPECT_NEAR(v.y[k] / 256.0, y, 0.5 / 256 + std::abs(y) * 4e-7 + 1e-4);
    EXPECT_NEAR(v.values[k][kDepth] * w, 1, 2e-7);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(v.values[k][kNormalX + axis], v.normal[axis][k] * v.values[k][kDepth]);
  }
  EXPECT_GT(inside, 1000);
}

}  // namespace
}  // namespace mars::shape
