#include "host/sinks/folder_turn.h"

#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/document/whole_file.h"
#include "tests/host/document/failure_of.h"
#include "tests/host/sinks/temporary_folder.h"

namespace mars::host {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

ProcessName elsewhere() {
  ProcessName process = this_process();
  process.host = "n7";
  process.boot = "another";
  return process;
}

ProcessName ended() {
  ProcessName process = this_process();
  process.start -= 1;
  return process;
}

void age(const fs::path& file, std::chrono::seconds by) {
  fs::last_write_time(file, fs::last_write_time(file) - by);
}

TEST(FolderTurn, OneAtATime) {
  const TemporaryFolder folder;
  std::atomic<int> at_once = 0, taken = 0, together = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i)
      threads.emplace_back([&] {
        for (int n = 0; n < 15; ++n) {
          const RunsFolder runs(folder.path(), this_process());
          const FolderTurn turn(runs);
          together += ++at_once > 1;
          std::this_thread::sleep_for(500us);
          turn.confirm();
          --at_once;
          ++taken;
        }
      });
  }
  EXPECT_EQ(taken, 120);
  EXPECT_EQ(together, 0);
  EXPECT_EQ(folder.entries(), 0u) << "nothing is left, not even .runs";
}

TEST(FolderTurn, ThatOfAnEndedRunDoesNotCount) {
  const TemporaryFolder folder;
  const RunsFolder before(folder.path(), ended()), runs(folder.path(), this_process());
  before.add_own_file(kTurnEnding, to_json(before.self()).dump());
  EXPECT_EQ(failure_of([&] { FolderTurn(runs, 2s); }), "");
}

TEST(FolderTurn, OfARunOnAnotherMachineItCountsForAMinute) {
  const TemporaryFolder folder;
  const RunsFolder there(folder.path(), elsewhere()), runs(folder.path(), this_process());
  const fs::path turn = there.add_own_file(kTurnEnding, to_json(there.self()).dump());
  age(turn, 50s);
  const std::string failure = failure_of([&] { FolderTurn(runs, 50ms); });
  EXPECT_TRUE(holds(failure, "on host n7, begins or ends in this folder, and does not go on")) << failure;
  age(turn, 15s);
  EXPECT_EQ(failure_of([&] { FolderTurn(runs, 2s); }), "");
}

TEST(FolderTurn, WhoHasLostItLearnsThat) {
  const TemporaryFolder folder;
  const RunsFolder runs(folder.path(), this_process());
  const FolderTurn turn(runs);
  turn.confirm();
  fs::remove(turn.file());
  EXPECT_TRUE(holds(failure_of([&] { turn.confirm(); }), "another has taken it for ended"));
}

TEST(FolderTurn, NothingIsWrittenWhereALinkLeads) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "elsewhere");
  fs::create_directory(folder / "out");
  fs::create_directory_symlink("../elsewhere", folder / "out/.runs");
  const RunsFolder runs(folder / "out", this_process());
  EXPECT_TRUE(holds(failure_of([&] { const FolderTurn turn(runs); }), ".runs: is not a folder"));
  EXPECT_TRUE(fs::is_empty(folder / "elsewhere"));
}

TEST(RunsFolder, IsForWhomTheFolderOfFramesIsFor) {
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::group_write, fs::perm_options::add);
  const RunsFolder runs(folder.path(), this_process());
  const FolderTurn turn(runs);
  EXPECT_EQ(fs::status(folder / ".runs").permissions(), fs::status(folder.path()).permissions());
}

}  // namespace
}  // namespace mars::host
