#include "host/shell/launch/seen_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "host/content/document/whole_file.h"
#include "tests/temporary_folder.h"

namespace mars::launch {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr SeenFolder::Clock::time_point kBegin{100s};

void write(const fs::path& file) {
  fs::create_directories(file.parent_path());
  document::write_whole_file(file, "");
}

TEST(SeenFolder, IsMissedOnceItsClaimHasNotComeForLong) {
  const test::TemporaryFolder folder;
  write(folder / "frames.json");  // of this machine's own folder
  SeenFolder seen(folder.path());
  EXPECT_FALSE(seen.look("", kBegin - 1h)) << "the host may be compiling";
  EXPECT_FALSE(seen.look("run", kBegin));
  EXPECT_FALSE(seen.look("run", kBegin + SeenFolder::kPatience - 1ms));
  EXPECT_TRUE(seen.is_open());
  EXPECT_TRUE(seen.look("run", kBegin + SeenFolder::kPatience));
  EXPECT_TRUE(seen.is_missed());
  EXPECT_FALSE(seen.look("run", kBegin + 1h)) << "that is said once";
}

TEST(SeenFolder, IsSeenThoughFileSystemsShowItsClaimLate) {
  const test::TemporaryFolder folder;
  SeenFolder seen(folder.path());
  seen.look("run", kBegin);
  write(folder / ".runs/run.claim");
  EXPECT_FALSE(seen.look("run", kBegin + 1h));
  fs::remove_all(folder / ".runs");
  EXPECT_FALSE(seen.look("run", kBegin + 2h)) << "what happens to it later is another matter";
  EXPECT_FALSE(seen.is_open() || seen.is_missed());
}

TEST(SeenFolder, OfAShortJobIsSeenByWhatItLeaves) {
  const test::TemporaryFolder folder;
  SeenFolder sees(folder.path()), misses(folder / "none"), nothing("");
  for (SeenFolder* each : {&sees, &misses, &nothing}) each->look("run", kBegin);
  write(folder / "frames.json");
  for (SeenFolder* each : {&sees, &misses, &nothing}) each->look_for_frames(kBegin + SeenFolder::kPatience);
  EXPECT_FALSE(sees.is_missed());
  EXPECT_TRUE(misses.is_missed());
  EXPECT_FALSE(nothing.is_missed() || nothing.is_open());
}

}  // namespace
}  // namespace mars::launch
