// The compositor against a plain twin that copies the whole background for every frame.
#include "host/compositor/compositor.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "tests/host/document/failure_of.h"

namespace mars::host {
namespace {

constexpr std::uint32_t kPlain = 0x00302010;

struct Runs {
  std::vector<node::Run> runs;
  std::vector<std::uint32_t> pixels;
};

Runs random_runs(std::mt19937& random, std::uint32_t width, std::uint32_t height) {
  Runs out;
  for (std::uint32_t run = random() % 12; run > 0; --run) {
    const std::uint32_t first = random() % width;
    const std::uint32_t count = 1 + random() % (width - first);
    out.runs.push_back({static_cast<std::uint32_t>(random() % height), static_cast<std::uint16_t>(first),
                        static_cast<std::uint16_t>(count)});
    for (std::uint32_t i = 0; i < count; ++i) out.pixels.push_back(random() & 0xffffff);
  }
  return out;
}

void paste(const Runs& runs, std::uint32_t width, std::vector<std::uint32_t>& picture) {
  const std::uint32_t* source = runs.pixels.data();
  for (const node::Run& run : runs.runs)
    for (std::uint32_t x = 0; x < run.count; ++x) picture[run.line * width + run.first + x] = *source++;
}

// Blocks in which two pictures differ must be flagged.
void expect_told(const Frame& frame, const std::vector<std::uint32_t>& before) {
  const std::uint32_t block = frame.changed.block();
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    const auto x = static_cast<std::uint32_t>(i % frame.width);
    const auto y = static_cast<std::uint32_t>(i / frame.width);
    const bool told = frame.changed.at(x / block, y / block);
    ASSERT_TRUE(told || frame.pixels[i] == before[i]) << "changed at " << x << ", " << y;
  }
}

// Several intervals of one size, with frames from a small set of buffers in random order.
void expect_twins(std::uint32_t width, std::uint32_t height, std::uint32_t block, unsigned seed) {
  std::mt19937 random(seed);
  Compositor compositor(width, height, block, kPlain);
  std::vector<std::unique_ptr<Frame>> buffers;
  for (int i = 0; i < 3; ++i) buffers.push_back(std::make_unique<Frame>(width, height, block));
  for (int interval = 0; interval < 4; ++interval) {
    std::vector<std::uint32_t> background(std::size_t{width} * height, kPlain);
    compositor.begin_interval();
    for (int strip = interval % 3; strip > 0; --strip) {
      const Runs constant = random_runs(random, width, height);
      compositor.paste_constant(constant.runs, constant.pixels);
      paste(constant, width, background);
    }
    std::vector<std::uint32_t> before;
    for (std::uint32_t number = 0; number < 6; ++number) {
      Frame& frame = *buffers[random() % buffers.size()];
      std::vector<std::uint32_t> plain = background;
      compositor.begin_frame(frame, number);
      for (int strip = 0; strip < 2; ++strip) {
        const Runs moving = random_runs(random, width, height);
        compositor.paste_moving(frame, moving.runs, moving.pixels);
        paste(moving, width, plain);
      }
      compositor.finish_frame(frame);
      ASSERT_EQ(frame.pixels, plain) << width << "x" << height << ", blocks of " << block;
      ASSERT_EQ(frame.number, number);
      ASSERT_EQ(frame.changed_since.has_value(), number > 0);
      if (number > 0) expect_told(frame, before);
      before = plain;
    }
  }
}

TEST(Compositor, AsTheTwinThatCopiesEverything) {
  unsigned seed = 0;
  for (const std::uint32_t block : {1u, 2u, 3u, 5u, 8u, 16u, 31u, 64u, 16384u})
    for (const auto& [width, height] : {std::pair{1u, 1u}, {7u, 3u}, {64u, 64u}, {65u, 17u}, {131u, 97u}})
      expect_twins(width, height, block, ++seed);
}

TEST(Compositor, FramesPassFromOneToAnother) {
  Frame frame(20, 10, 4);
  Compositor first(20, 10, 4, 1);
  Compositor second(20, 10, 4, 2);
  const std::vector<node::Run> runs{{3, 2, 5}};
  const std::vector<std::uint32_t> pixels(5, 9);
  for (const auto& [compositor, background] : {std::pair{&first, 1u}, {&second, 2u}, {&first, 1u}}) {
    compositor->begin_frame(frame, 0);
    EXPECT_EQ(frame.pixels, std::vector<std::uint32_t>(200, background));
    compositor->paste_moving(frame, runs, pixels);
  }
}

// What was not flagged is not written again: a pixel spoilt behind the compositor's back stays spoilt.
TEST(Compositor, RestoresFlaggedBlocksOnly) {
  Compositor compositor(64, 64, 16, 0);
  Frame frame(64, 64, 16);
  compositor.begin_frame(frame, 0);
  compositor.paste_moving(frame, std::vector<node::Run>{{20, 20, 3}}, std::vector<std::uint32_t>(3, 7));
  compositor.finish_frame(frame);
  frame.pixels[0] = 5;
  frame.pixels[17 * 64 + 17] = 5;
  compositor.begin_frame(frame, 1);
  EXPECT_EQ(frame.pixels[0], 5u);
  EXPECT_EQ(frame.pixels[17 * 64 + 17], 0u);
  EXPECT_EQ(frame.pixels[20 * 64 + 20], 0u);
}

TEST(Compositor, TellsWhatChangedSinceTheFrameBefore) {
  Compositor compositor(64, 64, 16, 0);
  Frame frame(64, 64, 16);
  for (std::uint32_t number = 0; number < 2; ++number) {
    compositor.begin_frame(frame, number);
    const std::vector<node::Run> runs{{number * 40, static_cast<std::uint16_t>(number * 40), 1}};
    compositor.paste_moving(frame, runs, std::vector<std::uint32_t>{7});
    compositor.finish_frame(frame);
  }
  EXPECT_EQ(frame.changed_since, 0u);
  EXPECT_EQ(frame.changed.count(), 2u);
  EXPECT_TRUE(frame.changed.at(0, 0));
  EXPECT_TRUE(frame.changed.at(2, 2));
}

TEST(Compositor, WrongStripsAreFailuresAndLeaveThePictureAlone) {
  Compositor compositor(10, 5, 4, 0);
  Frame frame(10, 5, 4);
  compositor.begin_frame(frame, 0);
  const std::vector<std::uint32_t> pixels(3, 7);
  const auto wrong = [&](node::Run run) {
    const std::vector<node::Run> runs{{0, 0, 0}, run};
    const std::span<const node::Run> one = std::span(runs).subspan(1);
    const std::string moving = failure_of([&] { compositor.paste_moving(frame, one, pixels); });
    EXPECT_EQ(moving, failure_of([&] { compositor.paste_constant(one, pixels); }));
    return moving;
  };
  EXPECT_TRUE(holds(wrong({5, 0, 3}), "3 pixels from column 0 of line 5"));
  EXPECT_TRUE(holds(wrong({0, 8, 3}), "outside the picture"));
  EXPECT_TRUE(holds(wrong({0xffffffff, 0xffff, 0xffff}), "outside the picture"));
  EXPECT_TRUE(holds(wrong({0, 0, 0}), "0 pixels"));
  EXPECT_TRUE(holds(wrong({0, 0, 2}), "has 3 pixels where its runs count 2"));
  EXPECT_TRUE(holds(wrong({0, 0, 4}), "has 3 pixels where its runs count 4"));
  EXPECT_EQ(frame.pixels, std::vector<std::uint32_t>(50, 0));
}

}  // namespace
}  // namespace mars::host
