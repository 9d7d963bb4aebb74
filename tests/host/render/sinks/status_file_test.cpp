#include "host/render/sinks/status_file.h"

#include <gtest/gtest.h>

#include <atomic>

#include "host/content/document/file.h"
#include "tests/comes.h"
#include "tests/host/render/sinks/small_folders.h"
#include "tests/temporary_folder.h"

namespace mars::sinks {
namespace {

using namespace std::chrono_literals;

TEST(StatusFile, IsWrittenAtOnceAgainAndAtTheEnd) {
  const test::TemporaryFolder folder;
  const auto file = folder / "run.status";
  std::atomic<int> number = 1;
  const auto text = [&] { return document::read_file_if_there(file, 100).value_or(""); };
  {
    const StatusFile status(
        file, folder / "run.status.part", [&] { return std::to_string(number); }, 50ms);
    EXPECT_TRUE(test::comes([&] { return text() == "1"; }));
    number = 2;
    EXPECT_TRUE(test::comes([&] { return text() == "2"; }));
  }
  {
    const StatusFile status(
        file, folder / "run.status.part", [&] { return std::to_string(number); }, 1h);
    EXPECT_TRUE(test::comes([&] { return text() == "2"; }));
    number = 3;
  }
  EXPECT_EQ(text(), "3");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(StatusFile, IsLeftOutWhereItCannotBeWritten) {
  const test::TemporaryFolder folder;
  const StatusFile nowhere(folder / "none/run.status", folder / "none/run.status.part", [] { return "1"; });
  const StatusFile failing(folder / "run.status", folder / "run.status.part",
                           []() -> std::string { throw std::runtime_error("no text"); });
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(StatusFile, OfAFolderIsGoneWithItsRun) {
  const test::TemporaryFolder folder;
  FrameFolder frames(folder.path(), small_manifest());
  frames.show_status([] { return Status(); });
  const auto has_status = [&] {
    const auto runs = RunsFolder(folder.path(), this_process()).runs();
    return std::ranges::any_of(runs.front().files, [](const auto& file) { return file.extension() == kStatusEnding; });
  };
  EXPECT_TRUE(test::comes(has_status));
  put_frames(frames, small_manifest(), 7);
  frames.finish();
  EXPECT_FALSE(std::filesystem::exists(folder / ".runs"));
}

}  // namespace
}  // namespace mars::sinks
