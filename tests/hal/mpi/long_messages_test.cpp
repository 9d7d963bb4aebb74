// Messages that are announced, for they are longer than MPI's counts: one of the real size, and many with the
// backend's bound lowered. Run by all ranks (mpi_main.cpp).
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hal/messages/process.h"
#include "hal/mpi/announcement.h"
#include "hal/mpi/mpi_backend.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/nx/nx_paragon.h"

namespace mars::mpi {
namespace {

constexpr long kBound = 100;
constexpr long kAnnouncement = sizeof(Announcement);
constexpr long kLargestType = 999'999'999;  // beyond the tags of some MPIs

using Bytes = std::vector<unsigned char>;

Bytes pattern(std::size_t length, std::size_t seed) {
  Bytes bytes(length);
  for (std::size_t i = 0; i < length; ++i) bytes[i] = static_cast<unsigned char>(seed + i * 7 + i / 251);
  return bytes;
}

// Looks like an announcement of more bytes than there are.
Bytes lookalike() {
  const Announcement announcement = Announcement::of(1 << 20);
  Bytes bytes(sizeof announcement);
  std::memcpy(bytes.data(), &announcement, sizeof announcement);
  return bytes;
}

// Node 0 is the sender, node 1 the receiver.
class LongMessages : public testing::Test {
 protected:
  void SetUp() override { dynamic_cast<MpiBackend&>(messages::process().backend()).announce_beyond(kBound); }
  void TearDown() override {
    if (mynode() != myhost()) gsync();
  }

  bool sends() const { return mynode() == 0; }
  bool receives() const { return mynode() == 1; }
};

TEST_F(LongMessages, ComeWholeAndInOrderAmongOthers) {
  constexpr int kMessages = 300;
  const auto length_of = [](int i) { return i % 3 == 0 ? i % kBound : i * 37L; };
  const auto type_of = [](int i) { return i % 5 == 0 ? kLargestType : 7L; };
  for (int i = 0; i < kMessages; ++i) {
    const Bytes bytes = pattern(static_cast<std::size_t>(length_of(i)), static_cast<std::size_t>(i));
    if (sends()) csend(type_of(i), bytes.data(), length_of(i), 1, 0);
    if (!receives()) continue;
    Bytes came(bytes.size());
    crecv(i % 2 == 0 ? type_of(i) : -1, came.data(), length_of(i));
    ASSERT_EQ(infocount(), length_of(i));
    ASSERT_EQ(infotype(), type_of(i));
    ASSERT_EQ(came, bytes) << "message " << i;
  }
}

TEST_F(LongMessages, ProbesFindTheLength) {
  const Bytes bytes = pattern(5000, 1);
  if (sends()) csend(3, bytes.data(), 5000, 1, 0);
  if (!receives()) return;
  cprobe(-1);
  EXPECT_EQ(infocount(), 5000);
  Bytes came(5000);
  EXPECT_EQ(_crecv(3, came.data(), 4999), -1) << "too short a buffer";
  crecv(3, came.data(), 5000);
  EXPECT_EQ(came, bytes);
}

TEST_F(LongMessages, AreSentAndReceivedInTheBackground) {
  constexpr int kAtOnce = 20;
  std::vector<Bytes> buffers;
  std::vector<long> ids;
  for (int i = 0; i < kAtOnce; ++i) {
    buffers.push_back(sends() ? pattern(20'000, static_cast<std::size_t>(i)) : Bytes(20'000));
    if (sends()) ids.push_back(isend(i % 4, buffers.back().data(), 20'000, 1, 0));
    if (receives()) ids.push_back(irecv(i % 4, buffers.back().data(), 20'000));
  }
  for (const long id : ids) msgwait(id);
  for (int i = 0; receives() && i < kAtOnce; ++i)
    ASSERT_EQ(buffers[static_cast<std::size_t>(i)], pattern(20'000, static_cast<std::size_t>(i)));
}

// A receive of one type, which may overtake others, meets announcements of several types.
TEST_F(LongMessages, AreReceivedByType) {
  constexpr int kRounds = 50;
  for (int round = 0; round < kRounds; ++round) {
    const Bytes first = pattern(3000, 11), second = pattern(2000, 12);
    if (sends()) {
      csend(1, first.data(), 3000, 1, 0);
      csend(2, second.data(), 2000, 1, 0);
      csend(2, second.data(), 10, 1, 0);
    }
    if (!receives()) continue;
    Bytes came(3000);
    crecv(2, came.data(), 2500);
    ASSERT_EQ(infocount(), 2000);
    ASSERT_TRUE(std::equal(second.begin(), second.end(), came.begin()));
    crecv(1, came.data(), 3000);
    ASSERT_EQ(came, first);
    crecv(2, came.data(), 10);
    ASSERT_EQ(infocount(), 10);
  }
}

TEST_F(LongMessages, OnesThatLookLikeAnnouncementsComeAsTheyAre) {
  const Bytes bytes = lookalike();
  for (const long type : {5L, kLargestType}) {
    if (sends()) {
      csend(type, bytes.data(), kAnnouncement, 1, 0);
      msgwait(isend(type, bytes.data(), kAnnouncement, 1, 0));
      csend(type, pattern(kAnnouncement, 1).data(), kAnnouncement, 1, 0);
    }
    if (!receives()) continue;
    Bytes came(kAnnouncement);
    for (int i = 0; i < 2; ++i) {
      crecv(type, came.data(), kAnnouncement);
      EXPECT_EQ(infocount(), kAnnouncement);
      EXPECT_EQ(came, bytes);
    }
    crecv(type, came.data(), kAnnouncement);
    EXPECT_EQ(came, pattern(kAnnouncement, 1));
  }
}

TEST_F(LongMessages, ForceMessagesThatNobodyAwaitsAreDiscarded) {
  constexpr long kForce = 1'073'741'824;
  const Bytes bytes = pattern(1000, 1);
  if (sends()) {
    csend(kForce, bytes.data(), 1000, 1, 0);
    csend(9, bytes.data(), 1000, 1, 0);
  }
  if (!receives()) return;
  Bytes came(1000);
  crecv(9, came.data(), 1000);
  EXPECT_EQ(came, bytes);
}

TEST_F(LongMessages, CollectivesUseThem) {
  if (mynode() == myhost()) return;
  std::vector<double> x(1000, 1.5), work(1000);
  gdsum(x.data(), 1000, work.data());
  EXPECT_EQ(std::count(x.begin(), x.end(), 1.5 * static_cast<double>(numnodes())), 1000);
}

// Bytes that are free on this machine; 0 where it does not say.
std::uint64_t free_memory() {
  std::ifstream lines("/proc/meminfo");
  std::uint64_t kilobytes = 0;
  for (std::string word; lines >> word;)
    if (word == "MemAvailable:" && lines >> kilobytes) return kilobytes << 10;
  return 0;
}

TEST(VeryLongMessages, MoreThan2GiBAtOnce) {
  constexpr std::uint64_t kNeeded = std::uint64_t{5} << 30;
  constexpr long kLength = (std::int64_t{1} << 31) + 12'345;
  double available = static_cast<double>(free_memory());
  double work = 0;
  if (mynode() != myhost()) gdlow(&available, 1, &work);
  if (available < static_cast<double>(kNeeded)) GTEST_SKIP() << "needs 5 GiB of free memory";
  constexpr std::size_t kWords = kLength / sizeof(std::uint64_t) + 1;
  if (mynode() == 0) {
    std::vector<std::uint64_t> words(kWords);
    std::iota(words.begin(), words.end(), 1);
    msgwait(isend(1, words.data(), kLength, 1, 0));
  }
  if (mynode() == 1) {
    cprobe(1);
    ASSERT_EQ(infocount(), kLength);
    std::vector<std::uint64_t> words(kWords);
    crecv(1, words.data(), kLength);
    ASSERT_EQ(infocount(), kLength);
    std::uint64_t wrong = 0;
    for (std::uint64_t i = 0; i + 1 < kWords; ++i) wrong += words[i] != i + 1;
    EXPECT_EQ(wrong, 0u);
    std::uint64_t last = 0;
    const std::uint64_t sent = kWords;
    std::memcpy(&last, &sent, kLength % sizeof(std::uint64_t));
    EXPECT_EQ(words.back(), last) << "the last bytes, and none behind";
  }
  if (mynode() != myhost()) gsync();
}

}  // namespace
}  // namespace mars::mpi
