// The kernels of pixel groups: a plain twin's groups and sums, bit for bit, from every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "node/raster/kernels.h"
#include "node/simd/vector_slack.h"
#include "tests/node/shape/patches.h"
#include "tests/node/shape/sample_counts.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::raster {
namespace {

using shading::Extent;
using shading::kNoTriangle;

constexpr std::size_t kSlack = simd::kVectorSlack;

// What a line's samples show; nothing behind its columns.
struct LineOfIds {
  LineOfIds(std::int32_t width, const shape::SamplePattern& pattern)
      : pattern(pattern),
        stride(static_cast<std::size_t>(width) + kSlack),
        ids(stride * static_cast<std::size_t>(pattern.count), kNoTriangle) {}
  std::uint32_t& at(std::size_t column, std::int32_t sample) {
    return ids[static_cast<std::size_t>(sample) * stride + column];
  }
  std::uint32_t at(std::size_t column, std::int32_t sample) const {
    return ids[static_cast<std::size_t>(sample) * stride + column];
  }

  const shape::SamplePattern& pattern;
  std::size_t stride;
  std::vector<std::uint32_t> ids;
};

// Within `extent` stretches of pixels within one triangle or none, and of pixels whose samples show few or many.
LineOfIds random_line(shape::Random& random, std::int32_t width, Extent extent, const shape::SamplePattern& pattern) {
  LineOfIds line(width, pattern);
  for (std::uint32_t column = extent.first; column < extent.last;) {
    const std::uint32_t end = std::min(extent.last, column + static_cast<std::uint32_t>(random.whole(1, 40)));
    const int kind = random.whole(0, 4);
    const std::int32_t triangles = kind == 3 ? 3 : 1000;
    const auto any = [&] {
      return random.whole(0, 3) == 0 ? kNoTriangle : static_cast<std::uint32_t>(random.whole(0, triangles));
    };
    const std::uint32_t one = kind == 0 ? kNoTriangle : static_cast<std::uint32_t>(random.bits() >> 1);
    for (; column < end; ++column)
      for (std::int32_t s = 0; s < pattern.count; ++s) line.at(column, s) = kind < 3 ? one : any();
  }
  return line;
}

struct Group {
  shading::Fragment fragment;
  std::uint32_t mask;
  std::uint32_t pixel;  // its number among those that show something
};

bool operator==(const Group& a, const Group& b) {
  return a.fragment.triangle == b.fragment.triangle && a.fragment.column == b.fragment.column &&
         a.fragment.sample == b.fragment.sample && a.mask == b.mask && a.pixel == b.pixel;
}

// The first group of each pixel, then the others.
struct PlainGroups {
  std::vector<Group> firsts, others;
};

// The samples of a pixel in the order in which groups begin at them: each group has its first.
std::vector<std::int32_t> order_of(const shape::SamplePattern& pattern) {
  return {pattern.by_distance, pattern.by_distance + pattern.count};
}

PlainGroups group_plainly(const LineOfIds& line, Extent extent) {
  PlainGroups out;
  for (std::uint32_t column = extent.first; column < extent.last; ++column) {
    std::vector<Group> groups;
    for (const std::int32_t s : order_of(line.pattern)) {
      const std::uint32_t id = line.at(column, s);
      if (id == kNoTriangle) continue;
      const auto known = std::ranges::find_if(groups, [&](const Group& g) { return g.fragment.triangle == id; });
      if (known != groups.end())
        known->mask |= 1u << s;
      else
        groups.push_back({{id, static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(s)},
                          1u << s,
                          static_cast<std::uint32_t>(out.firsts.size())});
    }
    if (groups.empty()) continue;
    out.firsts.push_back(groups.front());
    out.others.insert(out.others.end(), groups.begin() + 1, groups.end());
  }
  return out;
}

// Arrays as long as a line's samples and twice the slack, and what lies behind them.
struct GroupSpace {
  explicit GroupSpace(const LineOfIds& line)
      : size(line.ids.size() + 2 * kSlack),
        fragments(size + 1),
        masks(size + 1, kUntouched),
        pixels(size + 1, kUntouched) {
    for (auto& channel : light) channel.assign(size + 1, -1.0f);
  }
  Groups groups() { return {fragments.data(), masks.data(), pixels.data()}; }
  Light lights() { return {{light[0].data(), light[1].data(), light[2].data()}}; }
  bool untouched_behind() const {
    return masks.back() == kUntouched && pixels.back() == kUntouched && fragments.back().triangle == 0 &&
           std::ranges::all_of(light, [](const auto& channel) { return channel.back() == -1.0f; });
  }

  static constexpr std::uint32_t kUntouched = 0xabcdef01;
  std::size_t size;
  std::vector<shading::Fragment> fragments;
  std::vector<std::uint32_t> masks, pixels;
  std::vector<float> light[3];
};

std::vector<Group> groups_in(const GroupSpace& space, const GroupCounts& counts) {
  std::vector<Group> out;
  for (std::uint32_t k = 0; k < counts.pixels + counts.others; ++k)
    out.push_back({space.fragments[k], space.masks[k], k < counts.pixels ? k : space.pixels[k]});
  return out;
}

// Each channel of each pixel is added up in the groups' order.
struct PlainPixel {
  float light[3];
  std::uint32_t mask;
};

std::vector<PlainPixel> add_plainly(const std::vector<Group>& groups, std::size_t pixels,
                                    const std::vector<float>* light, std::int32_t samples) {
  std::vector<PlainPixel> out(pixels);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    PlainPixel& pixel = out[groups[k].pixel];
    const float weight = static_cast<float>(std::popcount(groups[k].mask)) / static_cast<float>(samples);
    for (int c = 0; c < 3; ++c)
      pixel.light[c] = k < pixels ? weight * light[c][k] : pixel.light[c] + weight * light[c][k];
    pixel.mask |= groups[k].mask;
  }
  return out;
}

void expect_pixels(const GroupSpace& space, const std::vector<PlainPixel>& expected) {
  for (std::size_t k = 0; k < expected.size(); ++k) {
    ASSERT_EQ(space.masks[k], expected[k].mask) << "pixel " << k;
    for (int c = 0; c < 3; ++c)
      ASSERT_EQ(std::bit_cast<std::uint32_t>(space.light[c][k]), std::bit_cast<std::uint32_t>(expected[k].light[c]))
          << "pixel " << k << ", channel " << c;
  }
}

constexpr float kBackground[] = {0.3f, 0.7f, 1.9f};

void add_background_plainly(std::vector<PlainPixel>& pixels, std::int32_t samples) {
  for (PlainPixel& pixel : pixels) {
    const int left = samples - std::popcount(pixel.mask);
    for (int c = 0; c < 3; ++c)
      if (left > 0) pixel.light[c] += static_cast<float>(left) / static_cast<float>(samples) * kBackground[c];
  }
}

void expect_as_plainly(simd::InstructionSet set, const LineOfIds& line, Extent extent, shape::Random& random) {
  const RasterKernels& kernels = raster_kernels(set);
  const PlainGroups plain = group_plainly(line, extent);
  std::vector<Group> expected = plain.firsts;
  expected.insert(expected.end(), plain.others.begin(), plain.others.end());
  GroupSpace space(line);
  const LineSamples seen{nullptr, const_cast<std::uint32_t*>(line.ids.data()), static_cast<std::uint32_t>(line.stride)};
  const GroupCounts counts = kernels.group(line.pattern, seen, extent, space.groups());
  ASSERT_EQ(counts.pixels, plain.firsts.size());
  ASSERT_EQ(counts.others, plain.others.size());
  const std::vector<Group> groups = groups_in(space, counts);
  std::vector<Group> by_pixel = groups;
  std::stable_sort(by_pixel.begin() + counts.pixels, by_pixel.end(),
                   [](const Group& a, const Group& b) { return a.pixel < b.pixel; });
  ASSERT_TRUE(by_pixel == expected);
  for (auto& channel : space.light)
    for (std::size_t k = 0; k < expected.size(); ++k) channel[k] = static_cast<float>(random.real(0, 3));
  const auto samples = static_cast<std::uint32_t>(line.pattern.count);
  auto pixels = add_plainly(groups, plain.firsts.size(), space.light, line.pattern.count);
  kernels.add_groups(space.groups(), counts, samples, space.lights());
  expect_pixels(space, pixels);
  add_background_plainly(pixels, line.pattern.count);
  kernels.add_background(space.masks.data(), counts.pixels, samples, kBackground, space.lights());
  expect_pixels(space, pixels);
  ASSERT_TRUE(space.untouched_behind());
}

TEST(Groups, AreAPlainTwins) {
  shape::Random random(95);
  for (std::size_t trial = 0; trial < 3000; ++trial) {
    const shape::SamplePattern& pattern = shape::sample_pattern(shape::kSampleCounts[trial % 5]);
    const std::int32_t width = random.whole(1, trial % 7 ? 100 : 400);
    const std::int32_t first = trial % 3 ? 0 : random.whole(0, width - 1);
    const std::int32_t last = trial % 3 ? width : random.whole(first, width);
    const Extent extent{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last)};
    const LineOfIds line = random_line(random, width, extent, pattern);
    for (const simd::InstructionSet set : simd::all_sets()) {
      SCOPED_TRACE(std::string(simd::name_of(set)) + ", trial " + std::to_string(trial));
      expect_as_plainly(set, line, extent, random);
      if (HasFatalFailure()) return;
    }
  }
}

// As many groups as there are samples.
TEST(Groups, ALineOfSamplesThatAllDiffer) {
  shape::Random random(96);
  for (const std::uint32_t samples : shape::kSampleCounts)
    for (const std::int32_t width : {1, 15, 16, 17, 130}) {
      LineOfIds line(width, shape::sample_pattern(samples));
      for (std::size_t column = 0; column < static_cast<std::size_t>(width); ++column)
        for (std::int32_t s = 0; s < line.pattern.count; ++s)
          line.at(column, s) = static_cast<std::uint32_t>(16 * column) + static_cast<std::uint32_t>(s);
      for (const simd::InstructionSet set : simd::all_sets())
        expect_as_plainly(set, line, {0, static_cast<std::uint32_t>(width)}, random);
    }
}

}  // namespace
}  // namespace mars::raster
