#include "host/shell/batch/array_parts.h"

#include <gtest/gtest.h>

#include <string>

namespace mars::batch {
namespace {

// Tasks of so many frames each.
std::vector<farm::Task> tasks_of(const std::vector<std::uint32_t>& lengths) {
  std::vector<farm::Task> tasks;
  std::uint32_t frame = 0;
  for (const std::uint32_t length : lengths) {
    farm::Task task{static_cast<std::uint32_t>(tasks.size()), {}, 0};
    for (std::uint32_t i = 0; i < length; ++i) task.frames.push_back(frame++);
    tasks.push_back(task);
  }
  return tasks;
}

std::vector<std::string> parts_of(const std::vector<std::uint32_t>& lengths, std::size_t count) {
  std::vector<std::string> texts;
  for (const film::FrameSet& part : array_parts(tasks_of(lengths), count)) texts.push_back(part.text());
  return texts;
}

using Texts = std::vector<std::string>;

TEST(ArrayParts, AreOfAboutAsManyFramesEach) {
  EXPECT_EQ(parts_of({10, 10, 10, 10}, 2), (Texts{"0-19", "20-39"}));
  EXPECT_EQ(parts_of({5, 5, 30, 5, 5}, 3), (Texts{"0-9", "10-39", "40-49"}));
}

TEST(ArrayParts, NeverCutAnInterval) {
  EXPECT_EQ(parts_of({100, 1}, 2), (Texts{"0-99", "100"}));
  EXPECT_EQ(parts_of({50}, 7), (Texts{"0-49"}));
}

TEST(ArrayParts, HaveEachFrameOnce) {
  std::size_t frames = 0;
  for (const film::FrameSet& part : array_parts(tasks_of({1, 2, 3, 100, 4, 5, 6, 1, 1}), 4))
    frames += part.of_film(123).size();
  EXPECT_EQ(frames, 123u);
}

TEST(ArrayParts, OfOneAreAll) { EXPECT_EQ(parts_of({3, 4}, 1), (Texts{"0-6"})); }

}  // namespace
}  // namespace mars::batch
