// Which points triangles block: kernels against plain code, and meshes that have no gaps and cover nothing twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "node/shadow/block_plainly.h"
#include "node/shadow/points.h"
#include "tests/node/shadow/views.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::shadow {
namespace {

using shape::Random;

constexpr float kFarBehind = -1e9f;

// Of light from afar, for which vertices' places in space do not matter where they are on the grid.
const LightView kFromAfar = [] {
  LightView view{};
  view.u[0] = view.v[1] = view.axis[2] = 1;
  view.per_step = 1;
  return view;
}();

std::vector<std::uint32_t> all_of(const std::vector<PointVector>& points) {
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

// Bits of triangles that are left to plain code.
std::uint32_t block(simd::InstructionSet set, Grid& grid, const Mesh& mesh, const shape::Batch& batch,
                    std::vector<PointVector>& points, const LightView& view = kFromAfar) {
  static SmallBatches small;
  small.count = 0;
  const std::uint32_t large =
      shadow_kernels(set).set_up(view, grid.vertices(), mesh.triangles(), batch, kEverywhere, small);
  const auto all = all_of(points);
  shadow_kernels(set).block(small, points.data(), all.data(), static_cast<std::uint32_t>(all.size()));
  return large;
}

void block_plainly(const LightView& view, Grid& grid, const Caster& caster, std::uint32_t number,
                   std::vector<PointVector>& points) {
  for_each_piece(view, caster, grid.vertices(), number,
                 [&](const LargeTriangle& piece) { shadow::block_plainly(piece, points.data(), all_of(points)); });
}

// A caster whose vertices are nowhere but on the grid.
class OnGrid {
 public:
  OnGrid(const Grid& grid, const Mesh& mesh)
      : zeros_(grid.x.size()),
        caster{{zeros_.data(), zeros_.data(), zeros_.data()},
               static_cast<std::uint32_t>(grid.x.size()),
               mesh.triangles()} {}

 private:
  std::vector<float> zeros_;

 public:
  const Caster caster;
};

TEST(Block, IsThePlainTwinsEverywhere) {
  Random random(53);
  std::size_t blocked = 0, open = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int most = 1 << random.whole(2, 14), z = random.whole(1, 1 << 20);
    const GridPoint middle{random.whole(-(1 << 28), 1 << 28), random.whole(-(1 << 28), 1 << 28)};
    const auto near = [&](std::int32_t at) { return at + random.whole(-most, most); };
    Grid grid(60);
    for (std::size_t k = 0; k < 60; ++k) {
      grid.x[k] = near(middle.x), grid.y[k] = near(middle.y);
      grid.z[k] = static_cast<float>(random.whole(-z, z));
    }
    Mesh mesh;
    for (int k = 0; k < 40; ++k) {
      const auto corner = [&] { return static_cast<std::uint32_t>(random.whole(0, 59)); };
      mesh.add(corner(), corner(), corner());
    }
    mesh.finish(16);
    std::vector<GridPoint> places;
    for (int k = 0; k < 200; ++k) places.push_back({near(middle.x), near(middle.y)});
    for (std::size_t k = 0; k < 60; ++k) places.push_back({grid.x[k], grid.y[k]});
    // All behind, or before all, so that rounding decides nothing.
    const bool behind = random.whole(0, 3) != 0;
    const auto before = vectors_of(places, behind ? kFarBehind : -kFarBehind, 1);
    auto plain = before;
    const OnGrid on_grid(grid, mesh);
    for (std::uint32_t k = 0; k < mesh.count(); ++k) block_plainly(kFromAfar, grid, on_grid.caster, k, plain);
    for (const simd::InstructionSet set : simd::all_sets()) {
      auto points = before;
      for (const shape::Batch& batch : mesh.batches) EXPECT_EQ(block(set, grid, mesh, batch, points), 0u);
      for (std::size_t k = 0; k < points.size(); ++k)
        ASSERT_EQ(points[k].blocked, plain[k].blocked) << simd::name_of(set) << ", trial " << trial;
    }
    for (const PointVector& v : plain) {
      blocked += static_cast<std::size_t>(std::popcount(v.blocked));
      open += static_cast<std::size_t>(std::popcount(v.active & ~v.blocked));
      if (!behind) {
        EXPECT_EQ(v.blocked, 0u);
      }
    }
  }
  EXPECT_GT(blocked, 20000u);
  EXPECT_GT(open, 20000u);
}

// Of triangles whose planes floats have exactly, each point where it is nearer by a little less and a little more than
// the bound: error * (slope + 1).
TEST(Block, BlocksWhatIsBehindByMoreThanTheBound) {
  Random random(54);
  for (int trial = 0; trial < 500; ++trial) {
    const std::int32_t side = 1 << random.whole(2, 7);
    const int per_x = random.whole(-8, 8), per_y = random.whole(-8, 8);
    Grid grid(3);
    const GridPoint corners[] = {{0, 0}, {side, 0}, {0, side}};
    for (std::size_t k = 0; k < 3; ++k) {
      grid.x[k] = corners[k].x + 1000, grid.y[k] = corners[k].y - 1000;
      grid.z[k] = static_cast<float>(100 + per_x * corners[k].x + per_y * corners[k].y);
    }
    Mesh mesh;
    random.whole(0, 1) ? mesh.add(0, 1, 2) : mesh.add(1, 0, 2);
    mesh.finish(16);
    const OnGrid on_grid(grid, mesh);
    const int x = random.whole(1, side / 2), y = random.whole(1, side / 4);
    const int error = random.whole(0, 5), bound = error * (std::abs(per_x) + std::abs(per_y) + 1);
    for (const float more : {0.0f, 0.5f}) {
      const float z = static_cast<float>(100 + per_x * x + per_y * y - bound) - more;
      const auto before = vectors_of({{x + 1000, y - 1000}}, z, static_cast<float>(error));
      auto plain = before;
      block_plainly(kFromAfar, grid, on_grid.caster, 0, plain);
      EXPECT_EQ(plain[0].blocked, more > 0 ? 1u : 0u) << trial;
      for (const simd::InstructionSet set : simd::all_sets()) {
        auto points = before;
        block(set, grid, mesh, mesh.batches[0], points);
        EXPECT_EQ(points[0].blocked, plain[0].blocked) << simd::name_of(set) << ", trial " << trial;
      }
    }
  }
}

// Points of a surface that is seen from anywhere, and triangles about where they are: the plane near the points leaves
// out none that blocks.
TEST(Block, ThePlaneNearPointsLeavesOutNothing) {
  Random random(58);
  std::size_t blocked = 0, open = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const auto kind = random.whole(0, 1) ? wire::LightKind::directional : wire::LightKind::spot;
    auto light = random_light(random, kind);
    if (light.vector[2] > 0 && kind == wire::LightKind::spot) light.vector[2] = 0;
    light.axis = {0, 0, -1};
    const LightViews views = light_views(light, kPicture);
    const double depth = random.real(0.03, 0.3), per_x = random.real(-2e-4, 2e-4), per_y = random.real(-2e-4, 2e-4);
    LanePlaces places;
    alignas(64) float inverse_w[kPointLanes];
    const bool on_a_line = random.whole(0, 4) == 0;
    for (int k = 0; k < kPointLanes; ++k) {
      places.x[k] = static_cast<float>(0.5 + k % 4), places.y[k] = static_cast<float>(0.5 + (on_a_line ? 0 : k / 4));
      inverse_w[k] = static_cast<float>(depth + per_x * places.x[k] + per_y * places.y[k]);
    }
    for (const simd::InstructionSet set : simd::all_sets()) {
      std::vector<PointVector> points(1);
      shadow_kernels(set).put_points(views.views[0], views.frame, 104, 72, places, inverse_w,
                                     0xffff & ~(1u << trial % 16), points[0]);
      if (points[0].active == 0) continue;
      const GridBox& box = points[0].box;
      const LightView& view = views.views[0];
      const float error = points[0].error[(trial + 1) % kPointLanes] * (view.has_place ? box.low_z : 1.0f);
      Grid grid(12);
      Mesh mesh;
      const auto reach = [&](std::int32_t low, std::int32_t high) {
        const double r = std::min(20000.0, (double{high} - low) * 2 + 10);
        return static_cast<std::int32_t>((double{low} + high) / 2 + random.real(-r, r) * 0.49);
      };
      for (std::size_t k = 0; k < 12; ++k) {
        grid.x[k] = reach(box.low_x, box.high_x), grid.y[k] = reach(box.low_y, box.high_y);
        const float d = points[0].least + error * static_cast<float>(random.real(-1, 9));
        grid.z[k] = d + points[0].per_x * static_cast<float>(grid.x[k] - box.low_x) +
                    points[0].per_y * static_cast<float>(grid.y[k] - box.low_y);
      }
      for (std::uint32_t k = 0; k < 12; k += 3) mesh.add(k, k + 1, k + 2);
      mesh.finish(16);
      auto all = points;
      all[0].least = -std::numeric_limits<float>::max(), all[0].room = 0;
      const OnGrid on_grid(grid, mesh);
      auto plain = points, all_plain = all;
      LightView from_afar = kFromAfar;
      from_afar.per_step = view.per_step;
      block(set, grid, mesh, mesh.batches[0], points, view);
      block(set, grid, mesh, mesh.batches[0], all, view);
      ASSERT_EQ(points[0].blocked, all[0].blocked) << simd::name_of(set) << ", trial " << trial;
      for (std::uint32_t k = 0; k < mesh.count(); ++k) {
        block_plainly(from_afar, grid, on_grid.caster, k, plain);
        block_plainly(from_afar, grid, on_grid.caster, k, all_plain);
      }
      ASSERT_EQ(plain[0].blocked, all_plain[0].blocked) << "plainly, trial " << trial;
      blocked += static_cast<std::size_t>(std::popcount(points[0].blocked));
      open += static_cast<std::size_t>(std::popcount(points[0].active & ~points[0].blocked));
    }
  }
  EXPECT_GT(blocked, 1000u);
  EXPECT_GT(open, 1000u);
}

// A mesh of cells whose corners are moved a little, so that no triangle turns over; triangles run either way round.
struct Cells {
  Cells(Random& random, std::int32_t cells, std::int32_t size, GridPoint low)
      : grid(static_cast<std::size_t>((cells + 1) * (cells + 1))) {
    const auto number = [&](std::int32_t i, std::int32_t j) { return static_cast<std::uint32_t>(j * (cells + 1) + i); };
    for (std::int32_t j = 0; j <= cells; ++j)
      for (std::int32_t i = 0; i <= cells; ++i) {
        const auto moved = [&](std::int32_t k) {
          const bool rim = i == 0 || j == 0 || i == cells || j == cells;
          return k * size + (rim ? 0 : random.whole(-size / 5, size / 5));
        };
        grid.x[number(i, j)] = low.x + moved(i), grid.y[number(i, j)] = low.y + moved(j);
      }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      random.whole(0, 1) ? mesh.add(a, b, c) : mesh.add(c, b, a);
    };
    for (std::int32_t j = 0; j < cells; ++j)
      for (std::int32_t i = 0; i < cells; ++i) {
        const std::uint32_t a = number(i, j), b = number(i + 1, j), c = number(i + 1, j + 1), d = number(i, j + 1);
        if (random.whole(0, 1))
          add(a, b, c), add(a, c, d);
        else
          add(a, b, d), add(b, c, d);
      }
    mesh.finish(1);
  }
  Grid grid;
  Mesh mesh;
};

// How many triangles cover each place, by triangles one by one.
using BlockOne = std::function<void(std::uint32_t triangle, std::vector<PointVector>& points)>;

std::vector<int> count_covers(const std::vector<GridPoint>& places, std::uint32_t triangles,
                              const BlockOne& block_one) {
  std::vector<int> covers(places.size());
  auto points = vectors_of(places, kFarBehind);
  for (std::uint32_t k = 0; k < triangles; ++k) {
    for (PointVector& v : points) v.blocked = 0;
    block_one(k, points);
    for (std::size_t p = 0; p < places.size(); ++p)
      covers[p] += static_cast<int>(points[p / kPointLanes].blocked >> p % kPointLanes & 1);
  }
  return covers;
}

TEST(Block, AMeshCoversEachPlaceOnce) {
  Random random(55);
  for (const simd::InstructionSet set : simd::all_sets())
    for (int trial = 0; trial < 4; ++trial) {
      const std::int32_t cells = 4, size = trial < 2 ? 10 : 24;
      const GridPoint low{random.whole(-1000, 1000), random.whole(-(1 << 28), 1 << 28)};
      Cells mesh(random, cells, size, low);
      const OnGrid on_grid(mesh.grid, mesh.mesh);
      std::vector<GridPoint> places;
      for (std::int32_t y = -1; y <= cells * size + 1; ++y)
        for (std::int32_t x = -1; x <= cells * size + 1; ++x) places.push_back({low.x + x, low.y + y});
      const auto covers = count_covers(places, mesh.mesh.count(), [&](std::uint32_t k, auto& points) {
        if (trial % 2 == 1 && k % 3 == 0)  // the plain twin has the same rule
          block_plainly(kFromAfar, mesh.grid, on_grid.caster, k, points);
        else
          EXPECT_EQ(block(set, mesh.grid, mesh.mesh, mesh.mesh.batches[k], points), 0u);
      });
      for (std::size_t p = 0; p < places.size(); ++p) {
        const std::int32_t x = places[p].x - low.x, y = places[p].y - low.y, end = cells * size;
        const bool inside = x > 0 && y > 0 && x < end && y < end;
        const bool outside = x < 0 || y < 0 || x > end || y > end;
        if (inside) {
          ASSERT_EQ(covers[p], 1) << simd::name_of(set) << ": " << x << ' ' << y;
        } else {
          ASSERT_LE(covers[p], outside ? 0 : 1) << simd::name_of(set) << ": " << x << ' ' << y;
        }
      }
    }
}

// Neighbours of which one is small and one is large: each place by one of them.
TEST(Block, SmallAndLargeTrianglesShareEdges) {
  Random random(56);
  for (int trial = 0; trial < 200; ++trial) {
    const std::int32_t high = random.whole(1000, kMostSmall), low = random.whole(0, 900),
                       out = random.whole(200, 30000);
    const std::int32_t side = random.whole(0, 1) ? 1 : -1;
    Grid grid(4);
    const std::int32_t left = random.whole(-99, 99), lean = random.whole(0, 1) * random.whole(-99, 99);
    const GridPoint corners[] = {{left, 0}, {left + lean, high}, {-out, low}, {100000, low}};
    for (std::size_t k = 0; k < 4; ++k) grid.x[k] = side * corners[k].x, grid.y[k] = corners[k].y;
    Mesh mesh;
    mesh.add(0, 1, 2), mesh.add(0, 1, 3);
    mesh.finish(1);
    const OnGrid on_grid(grid, mesh);
    std::vector<GridPoint> places;
    for (int k = 0; k < 60; ++k) {
      const double y = random.whole(1, high - 1), x = corners[0].x + (corners[1].x - corners[0].x) * y / high;
      const auto at = static_cast<std::int32_t>(std::nearbyint(x));
      if (y > low + 1 && y < high - high / 5)
        places.push_back({side * (at + random.whole(-1, 1)), static_cast<std::int32_t>(y)});
    }
    for (const simd::InstructionSet set : simd::all_sets()) {
      const auto covers = count_covers(places, 2, [&](std::uint32_t k, auto& points) {
        const std::uint32_t large = block(set, grid, mesh, mesh.batches[k], points);
        EXPECT_EQ(large, k);
        if (large) block_plainly(kFromAfar, grid, on_grid.caster, k, points);
      });
      for (const int c : covers) ASSERT_EQ(c, 1) << simd::name_of(set) << ", trial " << trial;
    }
  }
}

// A fan round a place under a light, whose corners are far out and some of them behind it: what it sees of the fan, it
// sees once.
TEST(Block, AFanThatReachesBehindTheLightHasNoGap) {
  Random random(57);
  std::size_t cut = 0;
  for (int trial = 0; trial < 100; ++trial) {
    LightView view = light_views(random_light(random, wire::LightKind::spot), kPicture).views.front();
    ASSERT_EQ(view.is_face, 0u);
    // Before the light, at depth d, a plane that comes towards it on one side.
    const double d = random.real(0.5, 5), tilt = random.real(0.2, 2), turn = random.real(0, 6.28);
    const auto place = [&](double x, double y) {
      const double depth = d - tilt * (x * std::cos(turn) + y * std::sin(turn));
      shape::Vec3 out;
      for (std::size_t k = 0; k < 3; ++k) out[k] = view.place[k] + x * view.u[k] + y * view.v[k] + depth * view.axis[k];
      return out;
    };
    constexpr std::uint32_t kRim = 7;
    std::vector<float> axes[3];
    for (auto& axis : axes) axis.resize(kRim + 1 + simd::kVectorSlack);
    const auto put = [&](std::size_t k, const shape::Vec3& at) {
      for (std::size_t a = 0; a < 3; ++a) axes[a][k] = static_cast<float>(at[a]);
    };
    put(0, place(random.real(-0.01, 0.01), random.real(-0.01, 0.01)));
    Mesh mesh;
    for (std::uint32_t k = 0; k < kRim; ++k) {
      const double angle = 6.28318 * k / kRim, far = random.real(30, 60);
      put(k + 1, place(far * std::cos(angle), far * std::sin(angle)));
      mesh.add(0, k + 1, (k + 1) % kRim + 1);
    }
    mesh.finish(1);
    const Caster caster{{axes[0].data(), axes[1].data(), axes[2].data()}, kRim + 1, mesh.triangles()};
    Grid grid(kRim + 1);
    shadow_kernels(simd::best_instruction_set("")).project(view, caster.place, kRim + 1, grid.vertices());
    cut += static_cast<std::size_t>(std::count(grid.x.begin(), grid.x.begin() + kRim + 1, kOffGrid));
    std::vector<GridPoint> places{{grid.x[0], grid.y[0]}};
    for (int k = 0; k < 300; ++k) places.push_back({random.whole(-80000, 80000), random.whole(-80000, 80000)});
    for (std::uint32_t k = 1; k <= kRim; ++k)  // on edges, or nearly
      if (grid.x[k] != kOffGrid)
        for (const double part : {0.25, 0.5})
          places.push_back({static_cast<std::int32_t>(grid.x[0] + part * (grid.x[k] - grid.x[0])),
                            static_cast<std::int32_t>(grid.y[0] + part * (grid.y[k] - grid.y[0]))});
    std::erase_if(places, [](const GridPoint& p) { return std::hypot(p.x, p.y) > 100000; });
    const auto covers = count_covers(places, kRim, [&](std::uint32_t k, auto& points) {
      for (PointVector& v : points) std::fill_n(v.z, kPointLanes, -1e9f);
      block_plainly(view, grid, caster, k, points);
    });
    for (const int c : covers) ASSERT_EQ(c, 1) << "trial " << trial;
  }
  EXPECT_GT(cut, 100u);
}

}  // namespace
}  // namespace mars::shadow
