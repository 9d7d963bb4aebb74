#include "host/render/sinks/folder_turn.h"

#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <thread>

#include "host/content/document/whole_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::sinks {
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

void age(const fs::path& file, std::chrono::seconds by) { fs::last_write_time(file, fs::last_write_time(file) - by); }

TEST(FolderTurn, OneAtATime) {
  const test::TemporaryFolder folder;
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
  const test::TemporaryFolder folder;
  const RunsFolder before(folder.path(), ended()), runs(folder.path(), this_process());
  before.add_own_file(kTurnEnding, to_json(before.self()).dump());
  EXPECT_EQ(document::failure_of([&] { FolderTurn(runs, 2s); }), "");
}

TEST(FolderTurn, OfARunOnAnotherMachineItCountsForAMinute) {
  const test::TemporaryFolder folder;
  const RunsFolder there(folder.path(), elsewhere()), runs(folder.path(), this_process());
  const fs::path turn = there.add_own_file(kTurnEnding, to_json(there.self()).dump());
  age(turn, 50s);
  const std::string failure = document::failure_of([&] { FolderTurn(runs, 50ms); });
  EXPECT_TRUE(document::holds(failure, "on host n7, begins or ends in this folder, and does not go on")) << failure;
  age(turn, 15s);
  EXPECT_EQ(document::failure_of([&] { FolderTurn(runs, 2s); }), "");
}

TEST(FolderTurn, ARunWhoseFileIsRenamedMeanwhileHasNotEnded) {
  const test::TemporaryFolder folder;
  const RunsFolder runs(folder.path(), this_process());
  const FolderTurn turn(runs);
  EXPECT_FALSE(turn.has_ended({"n7-1-x", {folder / ".runs/n7-1-x.waits"}})) << "it was listed, and now is .turn";
}

TEST(FolderTurn, ARunThatWaitsRenewsItsFile) {
  const test::TemporaryFolder folder;
  const RunsFolder first(folder.path(), this_process()), second(folder.path(), this_process());
  std::optional<FolderTurn> turn(first);
  const std::jthread waits([&] { const FolderTurn late(second, 30s); });
  const auto age_of_its_file = [&] {
    std::error_code missing;  // it is renamed between .waits and .turn
    for (const std::string_view ending : {kWaitsEnding, kTurnEnding})
      if (const auto time = fs::last_write_time(second.own_file(ending), missing); !missing)
        return fs::file_time_type::clock::now() - time;
    return fs::file_time_type::duration(1h);
  };
  const auto becomes_young = [&] {
    for (int i = 0; i < 1000; ++i) {
      if (age_of_its_file() < 30s) return true;
      std::this_thread::sleep_for(5ms);
    }
    return false;
  };
  EXPECT_TRUE(becomes_young()) << "it is there";
  std::error_code missing;
  for (const std::string_view ending : {kWaitsEnding, kTurnEnding})
    fs::last_write_time(second.own_file(ending), fs::file_time_type::clock::now() - 70s, missing);
  EXPECT_TRUE(becomes_young());
  turn.reset();
}

TEST(FolderTurn, WhatTheSystemRefusesIsNotTakenForALoss) {
  const test::TemporaryFolder folder;
  const RunsFolder blocked(folder.path(), this_process()), runs(folder.path(), this_process());
  fs::create_directories(blocked.own_file(kTurnEnding));
  const std::string failure = document::failure_of([&] { const FolderTurn turn(blocked); });
  EXPECT_TRUE(document::holds(failure, ".turn: is not a regular file")) << failure;
  fs::remove(blocked.own_file(kTurnEnding));
  const FolderTurn turn(runs);
  fs::rename(folder / ".runs", folder / "away");
  fs::create_symlink(".runs", folder / ".runs");
  const std::string looped = document::failure_of([&] { turn.confirm(); });
  EXPECT_TRUE(document::holds(looped, "cannot renew: Too many levels of symbolic links")) << looped;
}

TEST(FolderTurn, PausesGrowAndDiffer) {
  GrowingPauses pauses;
  std::set<std::chrono::microseconds> long_ones;
  for (std::chrono::microseconds longest = 2ms; longest < 100ms; longest *= 2) {
    const std::chrono::microseconds pause = pauses.next();
    EXPECT_GE(pause, longest / 2);
    EXPECT_LE(pause, longest);
  }
  for (int i = 0; i < 20; ++i) {
    const std::chrono::microseconds pause = pauses.next();
    EXPECT_GE(pause, 50ms);
    EXPECT_LE(pause, 100ms);
    long_ones.insert(pause);
  }
  EXPECT_GT(long_ones.size(), 10u);
}

TEST(FolderTurn, WhoHasLostItLearnsThat) {
  const test::TemporaryFolder folder;
  const RunsFolder runs(folder.path(), this_process());
  const FolderTurn turn(runs);
  turn.confirm();
  fs::remove(turn.file());
  EXPECT_TRUE(document::holds(document::failure_of([&] { turn.confirm(); }), "another has taken it for ended"));
}

TEST(FolderTurn, NothingIsWrittenWhereALinkLeads) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "elsewhere");
  fs::create_directory(folder / "out");
  fs::create_directory_symlink("../elsewhere", folder / "out/.runs");
  const RunsFolder runs(folder / "out", this_process());
  EXPECT_TRUE(document::holds(document::failure_of([&] { const FolderTurn turn(runs); }), ".runs: is not a folder"));
  EXPECT_TRUE(fs::is_empty(folder / "elsewhere"));
}

TEST(RunsFolder, IsForWhomTheFolderOfFramesIsFor) {
  const test::TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::group_write, fs::perm_options::add);
  const RunsFolder runs(folder.path(), this_process());
  const FolderTurn turn(runs);
  EXPECT_EQ(fs::status(folder / ".runs").permissions(), fs::status(folder.path()).permissions());
}

}  // namespace
}  // namespace mars::sinks
