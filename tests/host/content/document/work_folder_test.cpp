#include "host/content/document/work_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <future>
#include <memory>

#include "hal/failure/failure.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::document {
namespace {

namespace fs = std::filesystem;
using Use = WorkFolder::Use;

class WorkFolderTest : public testing::Test {
 protected:
  static void put(const fs::path& file) { std::ofstream(file) << "x"; }
  void expect_refusal() const {
    EXPECT_TRUE(holds(failure_of([&] { WorkFolder(made_, Use::alone); }), "MARS has not made this one"));
  }

  const test::TemporaryFolder folder_;
  const fs::path made_ = folder_ / "film.mp4", work_ = folder_ / "film.mp4.mars-work";
};

TEST_F(WorkFolderTest, ItIsNamedAfterWhatIsMade) {
  EXPECT_EQ(work_folder_of("a/b"), "a/b.mars-work");
  EXPECT_EQ(work_folder_of("a/b/"), "a/b.mars-work");
  EXPECT_EQ(work_folder_of("a/b/."), "a/b.mars-work");
  EXPECT_EQ(work_folder_of("."), "./.mars-work");
  EXPECT_EQ(work_folder_of(".."), "../.mars-work");
  EXPECT_EQ(work_folder_of("/"), "/.mars-work");
}

TEST_F(WorkFolderTest, ItGoesWhereNothingIsInIt) {
  {
    const WorkFolder work(made_, Use::alone);
    EXPECT_TRUE(has_work_folder(made_));
    put(work.path() / "piece");
  }
  EXPECT_TRUE(has_work_folder(made_)) << "for the same command";
  fs::remove(work_ / "piece");
  { const WorkFolder work(made_, Use::shared); }
  EXPECT_FALSE(fs::exists(work_));
}

TEST_F(WorkFolderTest, WhatMarsHasNotMadeStays) {
  fs::create_directory(work_);
  put(work_ / "mine");
  EXPECT_FALSE(has_work_folder(made_));
  expect_refusal();
  EXPECT_TRUE(fs::exists(work_ / "mine"));
  fs::remove_all(work_);
  put(work_);
  expect_refusal();
  fs::remove(work_);
  fs::create_directory(folder_ / "elsewhere");
  fs::create_symlink("elsewhere", work_);
  expect_refusal();
}

TEST_F(WorkFolderTest, AnEmptyFolderIsOneOfAKilledProcess) {
  fs::create_directory(work_);
  { const WorkFolder work(made_, Use::alone); }
  EXPECT_FALSE(fs::exists(work_));
}

TEST_F(WorkFolderTest, TheSecondWaits) {
  auto first = std::make_unique<WorkFolder>(made_, Use::alone);
  std::promise<void> waits;
  auto second = std::async(std::launch::async, [&] {
    const WorkFolder work(made_, Use::alone, [&] { waits.set_value(); });
    return work.waited() && has_work_folder(made_);
  });
  waits.get_future().wait();
  first.reset();
  EXPECT_TRUE(second.get());
  EXPECT_FALSE(fs::exists(work_));
}

TEST_F(WorkFolderTest, NoDescriptorStaysWhereWaitingIsGivenUp) {
  const WorkFolder first(made_, Use::alone);
  const auto give_up = [] { throw Failure("was given up", "", ""); };
  EXPECT_TRUE(holds(failure_of([&] { WorkFolder(made_, Use::alone, give_up); }), "was given up"));
  std::error_code none;
  int descriptors = 0;
  for (const fs::directory_entry& each : fs::directory_iterator("/proc/self/fd"))
    descriptors += fs::read_symlink(each.path(), none) == fs::canonical(work_);
  EXPECT_EQ(descriptors, 1) << "the first one's";
}

TEST_F(WorkFolderTest, SharedFoldersStayWhileOneUsesThem) {
  const WorkFolder first(made_, Use::shared);
  {
    const WorkFolder second(made_, Use::shared, [] { ADD_FAILURE() << "it waits"; });
  }
  EXPECT_TRUE(has_work_folder(made_));
}

}  // namespace
}  // namespace mars::document
