// What an interval of a view may show of a skin: its bones one by one, what it is made of only as a whole.
#include "host/studio/stage/interval.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace mars::studio {
namespace {

using Parts = std::vector<std::uint32_t>;

constexpr std::uint32_t kSkin = 1, kLow = 2, kHigh = 3;  // numbers of a segment and its bones, behind both segments

wire::Matrix placed(double x) { return {{{{1, 0, 0, x}, {0, 1, 0, 0}, {0, 0, 1, 0}}}}; }

// A ball, and a sleeve of two bones; their first places and materials, which moments change.
wire::FilmData skin_scene() {
  wire::FilmData film;
  film.materials = {{{1, 0, 0}, 0.1f, 0.6f, 0.3f, 20, 2}, {{0, 1, 0}, 0.1f, 0.6f, 0.3f, 20, 2}};
  for (std::uint32_t value : {0u, 1u, 2u, 3u, 0u, 0u}) film.changes.push_back({0, value});
  film.matrices = {placed(0), placed(1), placed(2), placed(3)};
  film.segments = {{0, 0, {0, 1}, {4, 1}}, {1, 0, {1, 1}, {5, 1}, 0, 0, 2}};
  film.bones = {{2, 1}, {3, 1}};
  return film;
}

Shot shot_of(wire::FilmData film) { return {std::make_shared<const wire::FilmData>(std::move(film)), {}, 64, 48}; }

Shot with_bone(std::uint32_t part, double x) {
  wire::FilmData film = skin_scene();
  film.matrices[part] = placed(x);
  return shot_of(std::move(film));
}

Shot in_green() {
  wire::FilmData film = skin_scene();
  film.changes[5].value = 1;
  return shot_of(std::move(film));
}

Parts parts_of(const Moved& moved) {
  Parts parts;
  for (const wire::MovedSegment& each : moved.segments) parts.push_back(each.segment);
  return parts;
}

TEST(Interval, ABoneChangesWithItsSegmentAndAMaterialWithAllBones) {
  const Shot before = shot_of(skin_scene());
  EXPECT_EQ(changed_parts(before, with_bone(kHigh, 7)), (Parts{kSkin, kHigh}));
  EXPECT_EQ(changed_parts(before, in_green()), (Parts{kSkin, kLow, kHigh}));
  EXPECT_EQ(changed_parts(before, with_bone(kSkin, 7)), Parts()) << "where its joint would put it, nobody sees";
  EXPECT_EQ(changed_parts(before, with_bone(0, 7)), Parts{0});
}

TEST(Interval, OfASkinShowsTheBonesThatMayMove) {
  const Interval interval(shot_of(skin_scene()), {kSkin, kHigh});
  EXPECT_FALSE(interval.alone());
  const auto high = interval.moved_to(with_bone(kHigh, 7)), low = interval.moved_to(with_bone(kLow, 7));
  ASSERT_TRUE(high && low);
  EXPECT_EQ(parts_of(*high), Parts{kHigh});
  EXPECT_TRUE(interval.holds(*high));
  EXPECT_FALSE(interval.holds(*low));
}

TEST(Interval, AnotherMaterialNeedsAllOfASkin) {
  const auto green = Interval(shot_of(skin_scene()), {kSkin, kHigh}).moved_to(in_green());
  ASSERT_TRUE(green);
  EXPECT_EQ(parts_of(*green), Parts{kSkin});
  EXPECT_FALSE(Interval(shot_of(skin_scene()), {kSkin, kHigh}).holds(*green));
  EXPECT_TRUE(Interval(shot_of(skin_scene()), {kSkin, kLow, kHigh}).holds(*green));
}

}  // namespace
}  // namespace mars::studio
