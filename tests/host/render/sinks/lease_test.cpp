#include "host/render/sinks/lease.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "host/content/document/whole_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::sinks {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class LeaseOfAFile : public testing::Test {
 protected:
  LeaseOfAFile() {
    document::create_file(file_, "");
    fs::last_write_time(file_, fs::file_time_type::clock::now() - 1h);
  }
  bool is_young() const { return fs::file_time_type::clock::now() - fs::last_write_time(file_) < 30min; }

  const test::TemporaryFolder folder_;
  const fs::path file_ = folder_ / "file";
  std::atomic<double> now_ = 1000;
  Lease lease_{file_, [this] { return now_.load(); }};
};

TEST_F(LeaseOfAFile, IsRenewedByAThread) {
  const Lease often(file_, seconds_since_boot, 10ms);
  for (int i = 0; i < 1000 && !is_young(); ++i) std::this_thread::sleep_for(10ms);
  EXPECT_TRUE(is_young());
}

TEST_F(LeaseOfAFile, IsRenewedByItsHolderWhereTheThreadDidNot) {
  lease_.check();
  EXPECT_FALSE(is_young()) << "it is new, there is no need";
  now_ = 1031;
  lease_.check();
  EXPECT_TRUE(is_young());
}

TEST_F(LeaseOfAFile, WhoWasStoppedForLongLearnsThatItIsGone) {
  fs::remove(file_);
  EXPECT_EQ(document::failure_of([&] { lease_.check(); }), "") << "others wait longer before they take it away";
  EXPECT_TRUE(document::holds(document::failure_of([&] { Lease(file_).confirm(); }),
                              "file: this run's claim to the folder is gone"));
  now_ = 1031;
  EXPECT_TRUE(
      document::holds(document::failure_of([&] { lease_.check(); }), "file: this run's claim to the folder is gone"));
  document::create_file(file_, "");
  EXPECT_NE(document::failure_of([&] { lease_.check(); }), "") << "another's under its name is not its own";
}

TEST(Lease, OnceItCanBeRenewedAgainAllIsWell) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "below");
  document::create_file(folder / "below/file", "");
  std::atomic<double> now = 1000;
  Lease lease(folder / "below/file", [&] { return now.load(); });
  fs::rename(folder / "below", folder / "kept");
  fs::create_symlink("below", folder / "below");
  now = 1031;
  const std::string failure = document::failure_of([&] { lease.check(); });
  EXPECT_TRUE(document::holds(failure, "cannot be renewed: Too many levels of symbolic links")) << failure;
  fs::remove(folder / "below");
  fs::rename(folder / "kept", folder / "below");
  EXPECT_EQ(document::failure_of([&] { lease.check(); }), "");
}

}  // namespace
}  // namespace mars::sinks
