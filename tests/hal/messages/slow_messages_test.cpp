// Messages whose bytes come long after their envelope, as over a slow link: receives that do not wait leave the process
// free for what others send, and nobody sees a message before all of it is there.
#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <optional>
#include <vector>

#include "hal/messages/process.h"
#include "hal/messages/recorder.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/matching/scripted_backend.h"

namespace mars::messages {
namespace {

using Bytes = ScriptedBackend::Bytes;

constexpr long kLong = 5000;

std::vector<long> handled;

class SlowMessages : public testing::Test {
 protected:
  // Node 1 is behind the slow link and has sent a long message of type 5; node 2 sends a short one of type 6.
  SlowMessages() : process_(backend_) {
    std::iota(long_.begin(), long_.end(), static_cast<unsigned char>(0));
    backend_.be_slow(1);
    backend_.hand(1, 5, long_);
    backend_.hand(2, 6, Bytes{1});
    handled.clear();
  }

  void expect_long() const {
    EXPECT_EQ(into_, long_);
    EXPECT_EQ(infonode(), 1);
    EXPECT_EQ(infotype(), 5);
    EXPECT_EQ(infocount(), kLong);
  }

  void receive_short() const {
    ASSERT_EQ(iprobe(6), 1);
    char one = 0;
    crecv(6, &one, 1);
    EXPECT_EQ(one, 1);
    EXPECT_EQ(infonode(), 2);
  }

  ScriptedBackend backend_;
  Process process_;
  const Bytes nothing_ = Bytes(kLong);
  Bytes long_ = Bytes(kLong);
  Bytes into_ = Bytes(kLong);
};

TEST_F(SlowMessages, HoldUpNobody) {
  const long message = irecv(5, into_.data(), kLong);
  EXPECT_EQ(msgdone(message), 0);
  receive_short();
  EXPECT_EQ(msgdone(message), 0);
  EXPECT_EQ(iprobe(5), 0) << "it has its receive";
  backend_.bring();
  ASSERT_EQ(msgdone(message), 1);
  expect_long();
}

TEST_F(SlowMessages, HoldUpNobodyWhereTheyWaitForTheirReceive) {
  receive_short();
  ASSERT_EQ(iprobe(5), 1);
  EXPECT_EQ(infocount(), kLong);
  const long message = irecv(5, into_.data(), kLong);
  EXPECT_EQ(msgdone(message), 0);
  EXPECT_EQ(into_, nothing_);
  backend_.bring();
  ASSERT_EQ(msgdone(message), 1);
  expect_long();
}

TEST_F(SlowMessages, AreWaitedForByCallsThatWait) {
  backend_.meanwhile = [this] { backend_.bring(); };
  crecv(5, into_.data(), kLong);
  expect_long();
  backend_.hand(1, 5, long_);
  into_ = nothing_;
  msgwait(irecv(5, into_.data(), kLong));
  expect_long();
}

TEST_F(SlowMessages, AreReceivedInTheOrderInWhichTheyWereSent) {
  backend_.hand(1, 5, Bytes{7});
  char one = 0;
  const long first = irecv(5, into_.data(), kLong), second = irecv(5, &one, 1);
  EXPECT_EQ(msgdone(second), 0);
  EXPECT_EQ(msgdone(first), 0);
  backend_.bring();
  EXPECT_EQ(msgdone(second), 1);
  EXPECT_EQ(one, 7);
  ASSERT_EQ(msgdone(first), 1);
  expect_long();
}

TEST_F(SlowMessages, ThatAreGivenUpAreThereAgain) {
  const long message = irecv(5, into_.data(), kLong);
  EXPECT_EQ(msgdone(message), 0);
  backend_.meanwhile = [this] { backend_.bring(); };
  msgcancel(message);
  into_ = nothing_;
  crecv(5, into_.data(), kLong);
  expect_long();
}

TEST_F(SlowMessages, ThatAreThrownAwayComeFirst) {
  EXPECT_EQ(iprobe(5), 1);
  receive_short();
  bool came = false;
  backend_.meanwhile = [&] {
    came = true;
    backend_.bring();
  };
  flushmsg(5, -1, -1);
  EXPECT_TRUE(came) << "their memory is used again";
  EXPECT_EQ(iprobe(5), 0);
}

TEST_F(SlowMessages, HaveTheirHandlersInTheOrderInWhichTheyWereSent) {
  backend_.meanwhile = [this] { backend_.bring(); };
  char one = 0;
  masktrap(1);
  hrecv(5, into_.data(), kLong, [](long type, long, long, long) { handled.push_back(type); });
  hrecv(6, &one, 1, [](long type, long, long, long) { handled.push_back(type); });
  masktrap(0);
  EXPECT_EQ(handled, (std::vector<long>{5, 6}));
  EXPECT_EQ(into_, long_);
}

TEST_F(SlowMessages, AreRecordedWhenTheyAreThere) {
  Recorder recorder(100, 99);
  const auto taken = [&] {
    int messages = 0;
    for (const Event& event : recorder.turn(false)) messages += event.kind == Event::Kind::taken && event.what == 5;
    return messages;
  };
  const long message = irecv(5, into_.data(), kLong);
  EXPECT_EQ(msgdone(message), 0);
  EXPECT_EQ(taken(), 0);
  backend_.bring();
  EXPECT_EQ(msgdone(message), 1);
  EXPECT_EQ(taken(), 1);
}

}  // namespace
}  // namespace mars::messages
