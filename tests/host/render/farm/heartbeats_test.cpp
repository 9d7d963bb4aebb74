// The host's beats, what it reports of its nodes and when it gives one up, by a clock that waiting moves.
#include "host/render/farm/heartbeats.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "host/render/farm/node_inbox.h"
#include "tests/hal/timed_backend.h"

namespace mars::farm {
namespace {

constexpr int kNodes = 2;

class HeartbeatsTest : public testing::Test {
 protected:
  HeartbeatsTest() {
    listener.beat = [this](const std::string& doing, const std::vector<SilentNode>& silent) {
      reported.push_back({doing, silent, backend.now});
    };
    listener.asked_to_end = [this] { return asked_to_end; };
    listener.end = [this](const std::vector<NodeFrame>& drawing) {
      ended_with = drawing;
      throw std::runtime_error("ended");
    };
    listener.is_traced = [this](std::int32_t process) { return process == traced; };
    for (int node = 0; node < kNodes; ++node) {
      hellos.emplace_back().node = node;
      hellos.back().host = {'n', static_cast<char>('0' + node)};
    }
  }

  // These nodes beat once a second from now on.
  void let_speak(std::vector<int> speaking, wire::Beat beat = {.host = {'n'}, .process = 5, .frame = 3}) {
    backend.meanwhile = [=, this, next = 0.0]() mutable {
      if (backend.now < next) return;
      next = backend.now + 1;
      for (const int node : speaking) backend.hand(node, wire::kBeat, beat);
    };
  }

  void pass(double seconds) {
    for (const double end = backend.now + seconds; backend.now < end;) flick();
  }

  struct Reported {
    std::string doing;
    std::vector<SilentNode> silent;
    double when;
  };
  messages::TimedBackend backend{kNodes, kNodes};
  messages::Process process{backend};
  std::vector<wire::Hello> hellos;
  HeartbeatListener listener;
  std::vector<Reported> reported;
  std::vector<NodeFrame> ended_with;
  bool asked_to_end = false;
  std::int32_t traced = 0;
};

TEST_F(HeartbeatsTest, TellsNodesAndReaders) {
  Heartbeats heartbeats("n0", 42, listener);
  EXPECT_EQ(backend.sent_messages.size(), std::size_t{kNodes}) << "at once";
  heartbeats.set_doing("waiting for nodes");
  pass(60);
  EXPECT_NEAR(static_cast<double>(backend.sent_messages.size()), kNodes * 12, kNodes * 2);
  EXPECT_NEAR(static_cast<double>(reported.size()), 28, 3);
  EXPECT_EQ(reported.back().doing, "waiting for nodes");
  EXPECT_TRUE(reported.back().silent.empty()) << "nobody has greeted";
  for (std::size_t i = 1; i < reported.size(); ++i) EXPECT_LT(reported[i].when - reported[i - 1].when, 2.5);
}

TEST_F(HeartbeatsTest, NamesASilentNodeAndGivesItUp) {
  Heartbeats heartbeats("n0", 42, listener);
  heartbeats.watch(hellos);
  let_speak({0, 1}, {.host = {'n', '1'}, .frame = 17, .phase = wire::Phase::scanline});
  pass(10);
  const double silent_since = backend.now;
  let_speak({0});
  pass(9);
  ASSERT_EQ(reported.back().silent.size(), 1u);
  const SilentNode& named = reported.back().silent[0];
  EXPECT_EQ(named.node, 1);
  EXPECT_EQ(named.host, "n1");
  EXPECT_EQ(named.frame, 17);
  EXPECT_EQ(named.doing, "scanline");
  EXPECT_GE(named.seconds, 5);
  try {
    pass(100);
    FAIL() << "nothing was thrown";
  } catch (const NodeFailure& failure) {
    EXPECT_EQ(failure.node, 1);
    EXPECT_EQ(failure.frame, 17);
    EXPECT_NE(std::string(failure.what())
                  .find("n1 (node 1): hangs: it has said nothing for 30 s; it said last: "
                        "scanline of frame 17"),
              std::string::npos)
        << failure.what();
    EXPECT_NEAR(backend.now - silent_since, 30, 3);
  }
}

TEST_F(HeartbeatsTest, AStripIsASignOfLife) {
  Heartbeats heartbeats("n0", 42, listener);
  heartbeats.watch(hellos);
  let_speak({0});
  wire::Strip strip{};
  strip.node = 1;
  for (int i = 0; i < 20; ++i) {
    pass(4);
    heartbeats.hear(strip);
  }
  EXPECT_TRUE(reported.back().silent.empty());
}

TEST_F(HeartbeatsTest, WaitingForADebuggerIsNotHanging) {
  Heartbeats heartbeats("n", 42, listener);
  heartbeats.watch(hellos);
  let_speak({0, 1});
  pass(2);
  let_speak({});
  traced = 5;
  pass(300);
  EXPECT_EQ(reported.back().silent.size(), 2u);
  traced = 0;
  EXPECT_THROW(pass(1), NodeFailure);
}

TEST_F(HeartbeatsTest, ANodeElsewhereSaysThatADebuggerHasIt) {
  Heartbeats heartbeats("n0", 42, listener);
  heartbeats.watch(hellos);
  let_speak({0, 1}, {.traced = 1, .frame = 3});
  pass(2);
  let_speak({});
  pass(300);
  EXPECT_EQ(reported.back().silent[0].doing, "dice, in a debugger");
}

TEST_F(HeartbeatsTest, NodesThatWereAskedToEndAreNotWatched) {
  Heartbeats heartbeats("n0", 42, listener);
  heartbeats.watch(hellos);
  heartbeats.forget_nodes();
  const std::size_t sent = backend.sent_messages.size();
  pass(300);
  EXPECT_EQ(backend.sent_messages.size(), sent);
}

TEST_F(HeartbeatsTest, ABeatThatMakesNoSenseIsANodesFailure) {
  const wire::Beat sound{.frame = -1};
  for (int wrong = 0; wrong < 6; ++wrong) {
    Heartbeats heartbeats("n0", 42, listener);
    heartbeats.watch(hellos);
    wire::Beat beat = sound;
    if (wrong == 1) beat.frame = -2;
    if (wrong == 2) beat.phase = wire::Phase::keyframe;
    if (wrong == 3) beat.waits = 2;
    if (wrong == 4) beat.traced = 2;
    if (wrong == 5) beat.host.fill('n');
    backend.hand(1, wire::kBeat, beat);
    if (wrong == 0)
      EXPECT_NO_THROW(pass(1));
    else
      EXPECT_THROW(pass(1), NodeFailure) << wrong;
  }
}

TEST_F(HeartbeatsTest, OfABeatBeforeAllHaveGreetedNothingIsRead) {
  Heartbeats heartbeats("n0", 42, listener);
  backend.hand(1, wire::kBeat, messages::TimedBackend::Bytes(1000));
  pass(1);
  EXPECT_EQ(iprobe(wire::kBeat), 0);
}

TEST_F(HeartbeatsTest, SaysWhatNodesDrawBeforeItEnds) {
  Heartbeats heartbeats("n0", 42, listener);
  heartbeats.watch(hellos);
  let_speak({0, 1});
  heartbeats.ask_for_drawing([](int node, std::int32_t begun) {
    EXPECT_EQ(begun, 3);
    return node == 1 ? std::optional<std::uint32_t>(8) : std::nullopt;
  });
  pass(1);
  asked_to_end = true;
  EXPECT_THROW(pass(1), std::runtime_error);
  ASSERT_EQ(ended_with.size(), 1u);
  EXPECT_EQ(ended_with[0].node, 1);
  EXPECT_EQ(ended_with[0].frame, 8u);
}

TEST_F(HeartbeatsTest, BeatsDuringWorkOfAnotherThread) {
  Heartbeats heartbeats("n0", 42, listener);
  std::atomic<bool> seen = false;
  listener.beat = nullptr;
  const auto here = std::this_thread::get_id();
  asked_to_end = false;
  heartbeats.during("ending", [&] {
    EXPECT_NE(std::this_thread::get_id(), here);
    seen = true;
  });
  EXPECT_TRUE(seen);
  EXPECT_THROW(heartbeats.during("ending", [] { throw std::runtime_error("full"); }), std::runtime_error);
}

}  // namespace
}  // namespace mars::farm
