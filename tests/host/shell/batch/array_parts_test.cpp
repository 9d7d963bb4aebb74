#include "host/shell/batch/array_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace mars::batch {
namespace {

using Texts = std::vector<std::string>;

// Intervals of `lengths` frames; a keyframe works as long as `keyframe` inbetweens.
ArrayParts parts_of(const std::vector<std::uint32_t>& lengths, std::size_t count, double keyframe = 1) {
  std::vector<farm::Task> tasks;
  std::uint32_t frame = 0;
  for (const std::uint32_t length : lengths) {
    farm::Task task{static_cast<std::uint32_t>(tasks.size()), {}, 0};
    for (std::uint32_t i = 0; i < length; ++i) task.frames.push_back(frame++);
    tasks.push_back(task);
  }
  return array_parts(tasks, std::vector<farm::RoughWork>(tasks.size(), {keyframe, 1}), count);
}

Texts texts_of(const ArrayParts& parts) {
  Texts texts;
  std::ranges::transform(parts.frames, std::back_inserter(texts), &film::FrameSet::text);
  return texts;
}

TEST(ArrayParts, AreOfAboutEqualWork) {
  EXPECT_EQ(texts_of(parts_of({10, 10, 10, 10}, 2)), (Texts{"0-19", "20-39"}));
  EXPECT_EQ(texts_of(parts_of({6, 4, 5, 5}, 2, 10)), (Texts{"0-9", "10-19"}));
  EXPECT_EQ(texts_of(parts_of({3, 4}, 1)), Texts{"0-6"});
}

TEST(ArrayParts, CutAnIntervalThatIsTooLong) {
  EXPECT_EQ(texts_of(parts_of({50}, 5)), (Texts{"0-9", "10-19", "20-29", "30-39", "40-49"}));
  EXPECT_EQ(texts_of(parts_of({100, 1}, 2)), (Texts{"0-50", "51-100"}));
  EXPECT_EQ(texts_of(parts_of({5, 5, 30, 5, 5}, 3)), (Texts{"0-16", "17-33", "34-49"}));
}

TEST(ArrayParts, SaveAKeyframeWhereThatCostsLittle) {
  EXPECT_EQ(texts_of(parts_of({22, 18}, 2, 3)), (Texts{"0-21", "22-39"})) << "24 and 20, not 23 and 23";
  EXPECT_EQ(texts_of(parts_of({100, 1}, 2, 1000)), (Texts{"0-99", "100"})) << "a cut would make it longer";
}

TEST(ArrayParts, CostTheKeyframesThatTheyAdd) {
  EXPECT_EQ(parts_of({10, 10}, 2, 5).more_work, 0);
  EXPECT_EQ(texts_of(parts_of({38}, 3, 3)), (Texts{"0-12", "13-25", "26-37"}));
  EXPECT_NEAR(parts_of({38}, 3, 3).more_work, 4.0 / 40, 1e-9);
}

TEST(ArrayParts, AreNoMoreThanFrames) { EXPECT_EQ(texts_of(parts_of({2, 1}, 9)), (Texts{"0", "1", "2"})); }

TEST(ArrayParts, HaveEachFrameOnce) {
  for (std::size_t count = 1; count < 40; ++count) {
    const ArrayParts parts = parts_of({1, 2, 3, 100, 4, 5, 6, 1, 1}, count, 7);
    std::vector<std::uint32_t> frames;
    for (const film::FrameSet& part : parts.frames) std::ranges::copy(part.of_film(123), std::back_inserter(frames));
    EXPECT_LE(parts.frames.size(), count);
    EXPECT_EQ(frames.size(), 123u);
    EXPECT_TRUE(std::ranges::is_sorted(frames));
  }
}

}  // namespace
}  // namespace mars::batch
