// Pixels of groups, where what they come to is known: pure colours, shares of four samples, a background.
#include "node/raster/pixel_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <vector>

#include "tests/node/simd/instruction_sets.h"

namespace mars::raster {
namespace {

constexpr std::uint32_t kGroupWidth = 40, kGroupLine = 3, kGroupSamples = 4;

enum Shown : std::uint32_t { kRed, kGreen, kBlue, kColors, kNothing = shading::kNoTriangle };
using Pixel = std::array<Shown, kGroupSamples>;

// A scene of three triangles, each evenly of one colour in light from all around, before a dark background.
struct Scene {
  Scene() {
    for (std::uint32_t k = 0; k < kColors; ++k) {
      materials[k].ambient = 1;
      materials[k].color[k] = 1;
      triangles[k].at_first[shape::kDepth] = 0.5f;
      triangles[k].material = k;
    }
  }
  shading::Shading shading() const {
    shading::Shading shading{};
    shading.triangles = triangles.data();
    shading.materials = materials.data();
    shading.projection.scale = 100;
    shading.pattern = shape::sample_pattern(kGroupSamples);
    std::fill_n(shading.background, 3, 0.2f);
    return shading;
  }
  std::array<geometry::Triangle, kColors> triangles{};
  std::array<wire::Material, kColors> materials{};
};

// What a line shows from column 0 on, and nothing behind it.
class PixelLine {
 public:
  PixelLine(std::initializer_list<Pixel> pixels) : ids_(kGroupSamples * kStride, kNothing) {
    for (const Pixel& pixel : pixels) {
      for (std::uint32_t s = 0; s < kGroupSamples; ++s) ids_[s * kStride + extent.last] = pixel[s];
      ++extent.last;
    }
  }
  LineSamples samples() { return {nullptr, ids_.data(), kStride}; }

  shading::Extent extent{0, 0};

 private:
  static constexpr std::uint32_t kStride = kGroupWidth + simd::kVectorSlack;
  std::vector<std::uint32_t> ids_;
};

constexpr Pixel all(Shown shown) { return {shown, shown, shown, shown}; }

// Still groups of a line, of as many as fit.
struct Still {
  StillGroups groups() { return {end.data(), all.data()}; }
  std::vector<std::uint32_t> end = std::vector<std::uint32_t>(kGroupWidth);
  std::vector<StillGroup> all = std::vector<StillGroup>(kGroupWidth * kGroupSamples);
};

// Where a strip's pixels and runs go.
struct Out {
  std::vector<std::uint32_t> pixels = std::vector<std::uint32_t>(kGroupWidth + simd::kVectorSlack);
  std::vector<wire::Run> runs = std::vector<wire::Run>(kGroupWidth);
  StripBuffer::Layer layer{reinterpret_cast<std::byte*>(pixels.data()), sizeof(std::uint32_t), runs.data()};
};

// As coded films show it: 255 for 1, rounded.
std::uint32_t shown(double red, double green, double blue) {
  const auto level = [](double light) { return static_cast<std::uint32_t>(255 * light + 0.5); };
  return level(red) | level(green) << 8 | level(blue) << 16;
}

void expect_run(const wire::Run& run, std::uint32_t first, std::uint32_t count) {
  EXPECT_EQ(run.line, kGroupLine);
  EXPECT_EQ(run.first, first);
  EXPECT_EQ(run.count, count);
}

class PixelGroupsTest : public testing::TestWithParam<simd::InstructionSet> {
 protected:
  PixelGroupsTest() : groups(GetParam(), kGroupWidth, kGroupSamples) {}
  PixelGroups& shade(PixelLine line) {
    groups.shade(shading, line.samples(), kGroupLine, line.extent);
    return groups;
  }

  const Scene scene;
  const shading::Shading shading = scene.shading();
  PixelGroups groups;
  Out out;
};

TEST_P(PixelGroupsTest, ResolveToTheirSharesAndTheBackground) {
  shade({all(kNothing), all(kRed), {kRed, kGreen, kNothing, kRed}, all(kNothing), {kNothing, kNothing, kBlue, kGreen}});
  EXPECT_EQ(groups.count(), 5u);
  groups.resolve(shading, kGroupLine, out.layer);
  ASSERT_EQ(out.layer.pixel_count(), 3u);
  EXPECT_EQ(out.pixels[0], shown(1, 0, 0));
  EXPECT_EQ(out.pixels[1], shown(0.5 + 0.05, 0.25 + 0.05, 0.05));
  EXPECT_EQ(out.pixels[2], shown(0.1, 0.25 + 0.1, 0.25 + 0.1));
  ASSERT_EQ(out.layer.runs().size(), 2u);
  expect_run(out.runs[0], 1, 2);
  expect_run(out.runs[1], 4, 1);
}

TEST_P(PixelGroupsTest, AreCopiedColumnByColumnInTheOrderOfTheirLowestSamples) {
  Still still;
  std::fill(still.end.begin(), still.end.end(), 99u);
  shade({all(kNothing), {kNothing, kGreen, kRed, kGreen}, all(kNothing), all(kBlue)})
      .copy_to(still.groups(), shading, kGroupLine);
  for (std::uint32_t column = 0; column < kGroupWidth; ++column)
    EXPECT_EQ(still.groups().of(column).size(), column == 1 ? 2u : column == 3 ? 1u : 0u) << column;
  const auto is = [](const StillGroup& group, Shown color, std::uint32_t samples) {
    for (std::uint32_t c = 0; c < 3; ++c) EXPECT_EQ(group.light[c], c == color ? 1.0f : 0.0f);
    EXPECT_EQ(group.samples, samples);
  };
  is(still.groups().of(1)[0], kGreen, 0b1010);
  is(still.groups().of(1)[1], kRed, 0b0100);
  is(still.groups().of(3)[0], kBlue, 0b1111);
}

TEST_P(PixelGroupsTest, OfAnEmptyLineAreNone) {
  Still still;
  std::fill(still.end.begin(), still.end.end(), 99u);
  shade({}).copy_to(still.groups(), shading, kGroupLine);
  EXPECT_EQ(still.end, std::vector<std::uint32_t>(kGroupWidth, 0));
  groups.resolve(shading, kGroupLine, out.layer);
  EXPECT_EQ(out.layer.pixel_count(), 0u);
  EXPECT_TRUE(out.layer.runs().empty());
}

// What a moving part leaves of a pixel is shared by what stands still there and the background; pixels that it does not
// touch are not its own.
TEST_P(PixelGroupsTest, ResolveOverWhatStandsStill) {
  Still still;
  shade({all(kRed),
         all(kRed),
         {kRed, kRed, kGreen, kNothing},
         {kGreen, kGreen, kNothing, kNothing},
         all(kNothing),
         all(kGreen)})
      .copy_to(still.groups(), shading, kGroupLine);
  shade({all(kBlue),
         {kBlue, kBlue, kNothing, kNothing},
         {kNothing, kBlue, kNothing, kNothing},
         {kBlue, kNothing, kNothing, kNothing},
         {kBlue, kNothing, kRed, kNothing}})
      .resolve_over(still.groups(), shading, kGroupLine, out.layer);
  ASSERT_EQ(out.layer.pixel_count(), 5u);
  EXPECT_EQ(out.pixels[0], shown(0, 0, 1));
  EXPECT_EQ(out.pixels[1], shown(0.5, 0, 0.5));
  EXPECT_EQ(out.pixels[2], shown(0.25 + 0.05, 0.25 + 0.05, 0.25 + 0.05));
  EXPECT_EQ(out.pixels[3], shown(0.1, 0.25 + 0.1, 0.25 + 0.1));
  EXPECT_EQ(out.pixels[4], shown(0.25 + 0.1, 0.1, 0.25 + 0.1));
  ASSERT_EQ(out.layer.runs().size(), 1u);
  expect_run(out.runs[0], 0, 5);
}

// Pixels of columns that are named beside those of moving parts: with still groups alone, in the order of columns;
// those which moving parts touch too are there once.
TEST_P(PixelGroupsTest, ResolveOverInColumnsThatHaveNoGroups) {
  const std::initializer_list<Pixel> still_pixels = {
      all(kRed), {kRed, kGreen, kNothing, kNothing}, all(kGreen), all(kRed), all(kRed), all(kNothing), all(kBlue)};
  const std::initializer_list<Pixel> moving_pixels = {
      all(kNothing), all(kNothing), all(kBlue), {kBlue, kBlue, kNothing, kNothing}};
  const std::uint32_t alone[] = {shown(1, 0, 0), shown(0.25 + 0.1, 0.25 + 0.1, 0.1),
                                 shown(0, 0, 1), shown(0.5, 0, 0.5),
                                 shown(1, 0, 0), shown(0.2, 0.2, 0.2),
                                 shown(0, 0, 1)};
  using Columns = std::vector<std::uint32_t>;
  for (const Columns& columns :
       {Columns{}, Columns{0}, Columns{0, 1}, Columns{1, 2}, Columns{2}, Columns{3, 4}, Columns{2, 3}, Columns{4},
        Columns{6}, Columns{0, 2, 4, 6}, Columns{0, 1, 2, 3, 4, 5, 6}, Columns{5, 6}}) {
    Still still;
    Out pixels;
    shade(still_pixels).copy_to(still.groups(), shading, kGroupLine);
    shade(moving_pixels).resolve_over(still.groups(), shading, kGroupLine, pixels.layer, columns);
    Columns expected = columns;
    expected.insert(expected.end(), {2, 3});
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    ASSERT_EQ(pixels.layer.pixel_count(), expected.size());
    Columns columns_of_runs;
    for (const wire::Run& run : pixels.layer.runs())
      for (std::uint32_t k = 0; k < run.count; ++k) columns_of_runs.push_back(run.first + k);
    EXPECT_EQ(columns_of_runs, expected);
    for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_EQ(pixels.pixels[k], alone[expected[k]]) << expected[k];
  }
}

TEST_P(PixelGroupsTest, ResolveOverInColumnsAlone) {
  Still still;
  shade({all(kRed), all(kNothing), all(kGreen)}).copy_to(still.groups(), shading, kGroupLine);
  const std::uint32_t columns[] = {0, 2};
  shade({}).resolve_over(still.groups(), shading, kGroupLine, out.layer, columns);
  ASSERT_EQ(out.layer.pixel_count(), 2u);
  EXPECT_EQ(out.pixels[0], shown(1, 0, 0));
  EXPECT_EQ(out.pixels[1], shown(0, 1, 0));
  ASSERT_EQ(out.layer.runs().size(), 2u);
  expect_run(out.runs[0], 0, 1);
  expect_run(out.runs[1], 2, 1);
}

// What is copied out comes back, with light from elsewhere.
TEST_P(PixelGroupsTest, AreRestoredWithLightFromElsewhere) {
  shade({all(kRed), {kRed, kGreen, kNothing, kRed}, {kNothing, kNothing, kBlue, kGreen}});
  const GroupCounts counts = groups.counts();
  const std::size_t room = groups.count() + simd::kVectorSlack;
  std::vector<shading::Fragment> fragments(room);
  std::vector<std::uint32_t> masks(room), of(room);
  groups.copy_to(Groups{fragments.data(), masks.data(), of.data()});
  groups.resolve(shading, kGroupLine, out.layer);
  Out again;
  groups.restore(counts, {fragments.data(), masks.data(), of.data()});
  for (std::uint32_t k = 0; k < groups.count(); ++k)
    for (std::size_t c = 0; c < 3; ++c) groups.light().channel[c][k] = fragments[k].triangle == c ? 1.0f : 0.0f;
  groups.resolve(shading, kGroupLine, again.layer);
  ASSERT_EQ(again.layer.pixel_count(), out.layer.pixel_count());
  for (std::size_t k = 0; k < out.layer.pixel_count(); ++k) EXPECT_EQ(again.pixels[k], out.pixels[k]);
}

INSTANTIATE_TEST_SUITE_P(Sets, PixelGroupsTest, testing::ValuesIn(simd::sets_here()),
                         [](const auto& info) { return std::string(simd::name_of(info.param)); });

}  // namespace
}  // namespace mars::raster
