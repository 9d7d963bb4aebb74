// A node's beats, and its end without those of its host, by a clock that waiting moves.
#include "node/heartbeat.h"

#include <gtest/gtest.h>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/timed_backend.h"

namespace mars::node {
namespace {

constexpr int kNodes = 3;
constexpr int kHost = kNodes;

class HeartbeatTest : public testing::Test {
 protected:
  // The host beats every five seconds until `end`.
  void host_beats_until(double end, const wire::Beat& beat = {}) {
    const double begin = backend.now;
    backend.meanwhile = [=, this, next = begin]() mutable {
      if (backend.now < next || backend.now >= end) return;
      next += 5;
      backend.hand(kHost, wire::kBeat, beat);
    };
  }

  void wait_until(double end) {
    while (backend.now < end) flick();
  }

  std::vector<wire::Beat> beats() {
    std::vector<wire::Beat> beats;
    for (const auto& message : backend.sent_messages) {
      EXPECT_EQ(message.type, wire::kBeat);
      EXPECT_EQ(message.to, kHost);
      std::memcpy(&beats.emplace_back(), message.bytes.data(), sizeof(wire::Beat));
    }
    return beats;
  }

  messages::TimedBackend backend{0, kNodes};
  messages::Process process{backend};
  NodeIdentity identity{"n7", "", {}, 0, "", 77, [this](std::int32_t id) { return id == traced; }};
  std::int32_t traced = 0;
};

TEST_F(HeartbeatTest, WithoutAHostThatBeatsThereIsNone) {
  Heartbeat heartbeat(identity);
  wait_until(backend.now + 300);
  EXPECT_TRUE(beats().empty());
}

TEST_F(HeartbeatTest, BeatsOnceASecondWhileACallWaits) {
  Heartbeat heartbeat(identity);
  const double begin = backend.now;
  host_beats_until(begin + 60);
  heartbeat.begin_frame(17);
  heartbeat.enter(wire::Phase::sum);
  wait_until(begin + 60);
  const std::vector<wire::Beat> sent = beats();
  EXPECT_GE(sent.size(), 50u);
  EXPECT_LE(sent.size(), 60u);
  const wire::Beat& last = sent.back();
  EXPECT_EQ(last.host.data(), std::string("n7"));
  EXPECT_EQ(last.process, 77);
  EXPECT_EQ(last.frame, 17);
  EXPECT_EQ(last.phase, wire::Phase::sum);
  EXPECT_EQ(last.waits, 1u);
}

TEST_F(HeartbeatTest, SaysAtOnceWhichFrameItBegins) {
  Heartbeat heartbeat(identity);
  heartbeat.begin_frame(3);
  EXPECT_TRUE(beats().empty()) << "no host beats yet";
  host_beats_until(backend.now + 1);
  wait_until(backend.now + 1);
  heartbeat.begin_frame(4);
  heartbeat.begin_frame(7);
  EXPECT_EQ(beats().back().frame, 7);
  EXPECT_EQ(beats()[beats().size() - 2].frame, 4);
}

TEST_F(HeartbeatTest, BeatsWhileItWorks) {
  Heartbeat heartbeat(identity);
  for (int second = 0; second < 60; ++second) {
    if (second % 5 == 0) backend.hand(kHost, wire::kBeat, wire::Beat{});
    for (int turn = 0; turn < 1000; ++turn, backend.now += 0.001) heartbeat.look_now_and_then();
  }
  EXPECT_GE(beats().size(), 50u);
  EXPECT_EQ(beats().back().waits, 0u);
}

TEST_F(HeartbeatTest, EndsWithoutAHostForHalfAMinute) {
  Heartbeat heartbeat(identity);
  const double dead = backend.now + 20;
  host_beats_until(dead);
  EXPECT_THROW(crecv(wire::kRender, nullptr, 0), HostLost);
  EXPECT_GE(backend.now, dead - 5 + 30);
  EXPECT_LE(backend.now, dead + 32);
}

TEST_F(HeartbeatTest, AJobThatWasSuspendedGoesOn) {
  Heartbeat heartbeat(identity);
  host_beats_until(backend.now + 1e9);
  for (int times = 0; times < 100; ++times) {
    wait_until(backend.now + 2);
    backend.now += 3600;
  }
  wait_until(backend.now + 10);
}

TEST_F(HeartbeatTest, AHostInADebuggerIsNotDead) {
  Heartbeat heartbeat(identity);
  wire::Beat beat{.process = 99};
  std::memcpy(beat.host.data(), "n7", 2);
  host_beats_until(backend.now + 1, beat);
  traced = 99;
  wait_until(backend.now + 300);
  traced = 0;
  EXPECT_THROW(wait_until(backend.now + 1), HostLost);
}

TEST_F(HeartbeatTest, AHostElsewhereMaySayThatItIsInADebugger) {
  Heartbeat heartbeat(identity);
  host_beats_until(backend.now + 1, {.traced = 1});
  wait_until(backend.now + 300);
}

TEST_F(HeartbeatTest, ABeatThatIsNoneEndsTheNode) {
  Heartbeat heartbeat(identity);
  backend.hand(kHost, wire::kBeat, messages::TimedBackend::Bytes(3));
  EXPECT_THROW(wait_until(backend.now + 2), Failure);
}

}  // namespace
}  // namespace mars::node
