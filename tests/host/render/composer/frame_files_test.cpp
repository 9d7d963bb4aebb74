#include "host/render/composer/frame_files.h"

#include <gtest/gtest.h>

#include <string>

#include "hal/failure/failure.h"
#include "tests/comes.h"

namespace mars::composer {
namespace {

// Were the file forgotten, its frame would be drawn again.
TEST(FrameFiles, GivesAFileThatIsThereBeforeTheFailureOfTheNext) {
  FrameFiles files(
      0, [](std::uint32_t frame) { return "frame-" + std::to_string(frame); },
      [](const FrameFile& file) {
        if (file.frame == 2) throw Failure("the folder is gone", "out", "");
      });
  EXPECT_FALSE(files.has_written());
  files.write({1, "hash", {}});
  files.write({2, "hash", {}});
  ASSERT_TRUE(test::comes([&] { return !files.is_full(); }));
  ASSERT_TRUE(test::comes([&] { return files.has_written(); }));
  EXPECT_EQ(files.take_written()->frame, 1u);
  EXPECT_FALSE(files.has_written());
  ASSERT_TRUE(test::comes([&] {
    try {
      return files.take_written().has_value();
    } catch (const Failure&) {
      return true;
    }
  }));
  EXPECT_THROW(files.take_written(), Failure);
}

}  // namespace
}  // namespace mars::composer
