// When files are there, against times worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>

#include "hal/simulated/storage_use.h"

namespace mars::simulated {
namespace {

constexpr double kOpening = 0.5, kBytes = 8;

// A file of kBytes takes a server 8 s.
struct Files : StorageUse {
  explicit Files(Storage storage, double port_byte = 0) : StorageUse(rated(storage), {.byte = port_byte}) {}
  double write(int computer, double begin) { return StorageUse::write(computer, begin, kBytes, 0); }
  // That many begin at once, each on a computer of its own.
  double last_of(int files) {
    double last = 0;
    for (int file = 0; file < files; ++file) last = std::max(last, write(file, 0));
    return last;
  }

 private:
  static Storage rated(Storage storage) {
    storage.byte = 1;
    return storage;
  }
};

TEST(Storage, TwoServersHalveTheTimeOfManyFiles) {
  EXPECT_DOUBLE_EQ(Files({}).last_of(12), 12 * 8);
  EXPECT_DOUBLE_EQ(Files({.servers = 2}).last_of(12), 6 * 8);
}

TEST(Storage, AFileIsOnOneServerUnlessItHasStripes) {
  EXPECT_DOUBLE_EQ(Files({.servers = 4}).last_of(1), 8);
  EXPECT_DOUBLE_EQ(Files({.servers = 4, .stripe = 2}).last_of(1), 2);
  EXPECT_DOUBLE_EQ(Files({.servers = 4, .stripe = 1}).last_of(1), 2) << "two stripes on each";
  EXPECT_DOUBLE_EQ(Files({.servers = 2, .stripe = 3}).last_of(1), 5) << "3 and 2 bytes, and 3";
  EXPECT_DOUBLE_EQ(Files({.servers = 2, .stripe = 100}).last_of(1), 8);
}

TEST(Storage, OneServerOpensAllFiles) {
  EXPECT_DOUBLE_EQ(Files({.opening = kOpening, .servers = 20}).last_of(10), 10 * kOpening + 8);
}

TEST(Storage, AFileGoesToTheServerThatCanBeginFirst) {
  Files files({.servers = 2});
  EXPECT_DOUBLE_EQ(files.write(0, 0), 8);
  EXPECT_DOUBLE_EQ(files.write(1, 4), 12);
  EXPECT_DOUBLE_EQ(files.write(2, 5), 16);
  EXPECT_DOUBLE_EQ(files.write(3, 5), 20);
}

TEST(Storage, FilesOfAComputerShareItsRate) {
  Files files({.servers = 8, .writer_byte = 2});
  EXPECT_DOUBLE_EQ(files.write(0, 0), 16);
  EXPECT_DOUBLE_EQ(files.write(0, 0), 32);
  EXPECT_DOUBLE_EQ(files.write(1, 0), 16) << "another computer";
}

TEST(Storage, NoFileComesFasterThanThroughItsPort) {
  Files files({.servers = 8, .stripe = 1}, 3);
  EXPECT_DOUBLE_EQ(files.write(0, 1), 1 + 24);
}

TEST(Storage, WithoutRatesTakesNoTime) {
  StorageUse files({.opening = kOpening}, {.byte = 5});
  EXPECT_DOUBLE_EQ(files.write(0, 1, kBytes, 0), 1 + kOpening);
}

}  // namespace
}  // namespace mars::simulated
