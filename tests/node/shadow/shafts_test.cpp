// Shafts leave out nothing that a point of the light finds: what casters block of the squares and batches that shafts
// meet is what all of them block of all points.
#include "node/shadow/shafts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "node/shadow/block_plainly.h"
#include "tests/node/shadow/views.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::shadow {
namespace {

using shape::Random;
using shape::Vec3;

constexpr std::uint32_t kWidth = 40, kHeight = 24;
constexpr int kSide = 13;  // vertices of a caster

// A surface that is seen all over the picture: w is its distance along the view axis.
struct Surface {
  double near, per_x, per_y, bumps, wave;

  explicit Surface(Random& random)
      : near(random.real(4, 30)),
        per_x(random.real(-0.02, 0.02) * near),
        per_y(random.real(-0.02, 0.02) * near),
        bumps(random.whole(0, 1) ? random.real(0, 0.01) * near : 0),
        wave(random.real(0.1, 1)) {}
  double w(double x, double y) const {
    return near + per_x * x + per_y * y + bumps * std::sin(wave * x) * std::sin(wave * y);
  }
  Vec3 place(double x, double y) const {
    const double at = w(x, y);
    return {(x - double{kPicture.center[0]}) / double{kPicture.scale} * at,
            (double{kPicture.center[1]} - y) / double{kPicture.scale} * at, -at};
  }
};

// A piece of the surface, moved to the light, with its own arrays.
struct Piece {
  std::vector<float> along[3];
  Mesh mesh;
  Caster caster;
  Hull hull{};

  Piece(const Surface& surface, double left, double top, double size, const Vec3& moved) {
    for (auto& axis : along) axis.resize(kSide * kSide + simd::kVectorSlack);
    for (int k = 0; k < kSide * kSide; ++k) {
      const Vec3 at = surface.place(left + size * (k % kSide) / (kSide - 1), top + size * (k / kSide) / (kSide - 1));
      for (std::size_t axis = 0; axis < 3; ++axis)
        along[axis][static_cast<std::size_t>(k)] = static_cast<float>(at[axis] + moved[axis]);
    }
    for (std::uint32_t j = 0; j + 1 < kSide; ++j)
      for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
        const std::uint32_t a = j * kSide + i;
        mesh.add(a, a + 1, a + kSide + 1);
        mesh.add(a, a + kSide + 1, a + kSide);
      }
    mesh.finish(16);
    caster = {{along[0].data(), along[1].data(), along[2].data()}, kSide * kSide, mesh.triangles()};
    for (int corner = 0; corner < 8; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax_element(along[axis].begin(), along[axis].begin() + kSide * kSide);
        hull.along[axis][corner] = corner >> axis & 1 ? *high : *low;
      }
    hull.count = 8;
  }
};

struct Picture {
  std::vector<float> depth;
  std::vector<wire::StillPairs> pairs;
  Layer layer;

  Picture(const Surface& surface, const shape::SamplePattern& pattern, Random& random)
      : depth(std::size_t{kWidth} * kHeight * static_cast<std::size_t>(pattern.count)), pairs(kWidth * kHeight) {
    const auto samples = static_cast<std::size_t>(pattern.count);
    layer.begin(kWidth, {0, kHeight});
    for (std::uint32_t y = 0; y < kHeight; ++y) {
      for (std::size_t s = 0; s < samples; ++s)
        for (std::uint32_t x = 0; x < kWidth; ++x)
          depth[(y * samples + s) * kWidth + x] =
              static_cast<float>(1 / surface.w(x + pattern.x[s] / double{shape::kSubpixels},
                                               y + pattern.y[s] / double{shape::kSubpixels}));
      layer.line(y) = {&depth[y * samples * kWidth], kWidth, &pairs[std::size_t{y} * kWidth], nullptr};
    }
    for (auto& p : pairs) p.lit = random.whole(0, 9) ? 0xffff : 0;
    layer.count_all_tiles();
  }
};

class ShaftsOfLights : public testing::TestWithParam<simd::InstructionSet> {
 protected:
  // Blocks what `casters` do of the parts, as each point of the light sees them.
  void block(const std::vector<ChunkCaster>& casters, const std::vector<TilePart>& parts, const LightViews& light,
             const shape::SamplePattern& pattern, Layer& layer) {
    const PairVectors vectors(pattern, true);
    for (std::uint32_t point = 0; point < light.points; ++point) {
      const PointSource source{kernels_, light.frame, pattern, vectors, 0, point};
      const auto views = std::span(light.views).subspan(std::size_t{point} * light.faces, light.faces);
      std::vector<Points> faces(views.size());
      for (const TilePart& part : parts) add_points(source, views, layer, part, faces);
      for (std::size_t f = 0; f < views.size(); ++f) {
        faces[f].finish();
        if (!faces[f].empty())
          for (const ChunkCaster& caster : casters) block(caster, views[f], faces[f]);
        faces[f].note(source, Casting::still);
      }
    }
  }

  void block(const ChunkCaster& caster, const LightView& view, Points& points) {
    grid_.put(view, caster.hull);
    const GridBox box = grid_.put(view, *caster.surface);
    const auto found = grid_.find_below(box, kRay, points);
    grid_.visit_batches(
        view, *caster.surface, kEverywhere,
        [&](const SmallBatches& batches, std::uint32_t) {
          kernels_.block(batches, points.vectors(), found.data(), static_cast<std::uint32_t>(found.size()));
        },
        [&](std::uint32_t triangle, std::uint32_t) {
          for_each_piece(view, *caster.surface, grid_.vertices(), triangle,
                         [&](const LargeTriangle& piece) { block_plainly(piece, points.vectors(), found); });
        });
  }

  const ShadowKernels& kernels_ = shadow_kernels(GetParam());
  GridCaster grid_{kernels_};
};

TEST_P(ShaftsOfLights, LeaveOutNothing) {
  Random random(81);
  const int trials = GetParam() == simd::best_instruction_set("") ? 60 : 5;
  std::size_t blocked = 0, met = 0, all = 0;
  for (const auto kind : {wire::LightKind::directional, wire::LightKind::point, wire::LightKind::spot})
    for (const std::uint32_t samples : {1u, 4u, 16u})
      for (int trial = 0; trial < trials; ++trial) {
        const shape::SamplePattern& pattern = shape::sample_pattern(samples);
        const Surface surface(random);
        auto light = random_light(random, kind, std::pow(10, random.real(-3, -0.5)));
        // From the side of the eye, and somewhere over the picture.
        light.vector[2] = std::abs(light.vector[2]) + (kind == wire::LightKind::directional ? 0.05f : 0);
        const Vec3 middle = surface.place(kWidth / 2.0, kHeight / 2.0);
        Vec3 way{light.vector[0], light.vector[1], light.vector[2]};
        if (kind != wire::LightKind::directional) {
          const double far = random.real(0.2, 1);
          for (std::size_t k = 0; k < 1; ++k) {
            way[k] *= far;
            light.vector[k] = static_cast<float>(middle[k] + way[k]);
            light.axis[k] = static_cast<float>(-way[k] / shape::length(way));
          }
        }
        // Where steps are wide, many triangles have no area on the middle's grid.
        shape::Projection steps = kPicture;
        if (trial % 2 != 0) steps.near = 3;
        const LightViews views = light_views(light, steps);
        Picture picture(surface, pattern, random);
        // Of one at a time: where there are several, one's squares hide what is left out of another's.
        const double height = random.whole(0, 2) ? std::pow(10, random.real(-4, 0)) : 0;
        const Piece piece(surface, random.real(-5, kWidth), random.real(-5, kHeight), random.real(0.5, 5),
                          {way[0] * height, way[1] * height, way[2] * height});
        const std::vector<ChunkCaster> casters{{piece.hull, &piece.caster, 0, true}};

        Shafts shafts(kernels_);
        const PairVectors hard(pattern, false);
        Layer* const layers[] = {&picture.layer};
        shafts.begin(views, {kernels_, views.frame, pattern, hard, 0, 0}, pairs_a_sample(samples, true), layers);
        std::vector<ChunkCaster> meeting;
        for (const ChunkCaster& caster : casters)
          if (shafts.meet(caster.hull, grid_)) meeting.push_back(caster);
        const Touched& some = shafts.find(meeting, grid_);
        const auto before = picture.pairs;
        block(some.casters, some.parts[0], views, pattern, picture.layer);
        std::vector<wire::StillPairs> found(before);
        std::swap_ranges(found.begin(), found.end(), picture.pairs.begin());
        std::vector<TilePart> everywhere;
        for (const std::uint32_t tile : picture.layer.tiles) everywhere.push_back({tile, TilePart::kAll});
        block(casters, everywhere, views, pattern, picture.layer);
        for (std::size_t k = 0; k < found.size(); ++k) {
          ASSERT_EQ(found[k].blocked, picture.pairs[k].blocked) << "pixel " << k;
          blocked += picture.pairs[k].blocked != 0;
        }
        all += 4 * everywhere.size();
        for (const TilePart& part : some.parts[0]) met += static_cast<std::size_t>(std::popcount(part.squares));
      }
  EXPECT_GT(blocked, 50u);
  EXPECT_LT(met, all / 2) << "shafts leave out some";
}

INSTANTIATE_TEST_SUITE_P(Sets, ShaftsOfLights, testing::ValuesIn(simd::sets_here()),
                         [](const auto& set) { return std::string(simd::name_of(set.param)); });

// A caster may block points less deep than the light is wide, however far the caster is before the light.
TEST(ShaftReach, LeavesOutNothingBeforePointsNearALight) {
  Random random(83);
  const LightViews light = light_views(random_light(random, wire::LightKind::point, 0.5), kPicture);
  const LightView& view = light.middle.front();
  Hull before{};
  before.count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) before.along[axis][0] = view.place[axis] + 50 * view.axis[axis];
  EXPECT_TRUE(is_near(light, 0, reach_of(light, 1 / 0.9f), before));
  EXPECT_FALSE(is_near(light, 0, reach_of(light, 1 / 9.0f), before));
}

TEST(ShaftReach, IsNearNothingWithoutPoints) {
  Random random(83);
  const LightViews light = light_views(random_light(random, wire::LightKind::point, 0.5), kPicture);
  const LightView& view = light.middle.front();
  Hull around{};
  around.count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) around.along[axis][0] = view.place[axis];
  EXPECT_FALSE(is_near(light, 0, reach_of(light, 0), around));
  EXPECT_TRUE(is_near(light, 0, reach_of(light, 1 / 9.0f), around));
}

}  // namespace
}  // namespace mars::shadow
