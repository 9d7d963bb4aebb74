// Strips to a host that gives credit, and a transport that is done with messages, when the test says so.
#include "node/group/outbox.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cstring>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "hal/template/template_backend.h"
#include "topology/memory_limit.h"

namespace mars::group {
namespace {

constexpr std::size_t kWidth = 16;

// A node alone with its host. What happens meanwhile stands in a script: each time that the node can do nothing but
// wait, its next event comes.
class ScriptedHost : public transport_template::TemplateBackend {
 public:
  struct Sent {
    int to, type;
    wire::Strip strip;
    bool gone = false;
  };

  bool has_host() const override { return true; }
  messages::Ticket start_send(int to, int type, const void* data, std::size_t length) override {
    Sent message{to, type, {}, transport_is_quick};
    EXPECT_EQ(length, sizeof message.strip) << "these strips are empty";
    std::memcpy(&message.strip, data, sizeof message.strip);
    messages.push_back(message);
    return static_cast<messages::Ticket>(messages.size() - 1);
  }
  bool sent(messages::Ticket ticket) override { return messages.at(static_cast<std::size_t>(ticket)).gone; }
  void idle(int, std::chrono::microseconds longest) override {
    if (longest < std::chrono::milliseconds(5)) return;  // in a call that does not wait
    if (script.empty()) throw Failure("the node waits for ever", "", "");
    ++waits;
    std::exchange(script.front(), {})();
    script.pop_front();
  }

  // Arrives as if from the host.
  void give_credit(int count) {
    const wire::Credit credit{count};
    send(rank(), wire::kCredit, &credit, sizeof credit);
  }

  std::vector<Sent> messages;
  std::deque<std::function<void()>> script;
  bool transport_is_quick = true;  // else messages are gone when the test sets it
  int waits = 0;
};

class OutboxTest : public testing::Test {
 protected:
  // The header as the outbox leaves it.
  wire::Strip send(Outbox& outbox) {
    wire::Strip header{};
    header.number = static_cast<std::uint32_t>(host.messages.size());
    outbox.begin(false);
    outbox.send(header);
    return header;
  }

  ScriptedHost host;
  messages::Process process{host};
};

TEST_F(OutboxTest, SendsAsManyStripsAsThereAreCredits) {
  Outbox outbox(kWidth, 3);
  for (std::uint32_t number = 0; number < 3; ++number) {
    EXPECT_EQ(send(outbox).work.credits_waited, 0u);
    const ScriptedHost::Sent& message = host.messages.at(number);
    EXPECT_EQ(message.to, host.host());
    EXPECT_EQ(message.type, wire::kStrip);
    EXPECT_EQ(message.strip.number, number);
  }
  EXPECT_EQ(host.waits, 0);
}

TEST_F(OutboxTest, WaitsForCreditAndSaysSo) {
  Outbox outbox(kWidth, 1);
  send(outbox);
  host.script = {[] {}, [&] { host.give_credit(1); }};
  const wire::Strip header = send(outbox);
  EXPECT_EQ(host.waits, 2);
  EXPECT_EQ(header.work.credits_waited, 1u);
  EXPECT_GT(header.times.credit, 0);
  EXPECT_EQ(host.messages.back().strip.work.credits_waited, 1u) << "the strip says so to the host";
  EXPECT_EQ(host.messages.size(), 2u);
}

TEST_F(OutboxTest, TakesWhatCreditHasCome) {
  Outbox outbox(kWidth, 3);
  for (int k = 0; k < 3; ++k) send(outbox);
  host.give_credit(1);
  host.give_credit(2);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(send(outbox).work.credits_waited, 0u);
  EXPECT_THROW(send(outbox), Failure) << "a seventh has none";
  EXPECT_EQ(host.messages.size(), 6u);
}

TEST_F(OutboxTest, RefusesMoreCreditThanItHasSpent) {
  Outbox outbox(kWidth, 2);
  send(outbox);
  host.give_credit(2);
  EXPECT_THROW(outbox.receive_credit(), Failure);
}

TEST_F(OutboxTest, ReceivesCreditWhileNothingIsSent) {
  Outbox outbox(kWidth, 1);
  send(outbox);
  host.script = {[&] { host.give_credit(1); }};
  outbox.receive_credit();
  EXPECT_EQ(send(outbox).work.credits_waited, 0u);
  EXPECT_EQ(host.waits, 1);
}

// Though there is credit: a buffer is not touched before its message has left it.
TEST_F(OutboxTest, ReusesABufferWhenItsMessageIsGone) {
  Outbox outbox(kWidth, 2);
  host.transport_is_quick = false;
  send(outbox);
  send(outbox);
  host.give_credit(2);
  host.script = {[&] { host.messages[1].gone = true; }, [&] { host.messages[0].gone = true; }};
  send(outbox);
  EXPECT_EQ(host.waits, 2) << "the first buffer's turn, not the second's";
  send(outbox);
  EXPECT_EQ(host.waits, 2) << "the second is free already";
}

TEST_F(OutboxTest, FlushWaitsUntilAllIsGone) {
  Outbox outbox(kWidth, 3);
  host.transport_is_quick = false;
  send(outbox);
  send(outbox);
  host.script = {[&] { host.messages[1].gone = true; }, [&] { host.messages[0].gone = true; }};
  outbox.flush();
  EXPECT_EQ(host.waits, 2);
  outbox.flush();
  EXPECT_EQ(host.waits, 2) << "nothing is left";
}

TEST_F(OutboxTest, AFailureOfTheTransportComesThrough) {
  Outbox outbox(kWidth, 1);
  send(outbox);
  host.script = {[] { throw Failure("the host is gone", "", ""); }};
  wire::Strip header{};
  outbox.begin(false);
  EXPECT_THROW(outbox.send(header), Failure);
  EXPECT_EQ(host.messages.size(), 1u);
}

TEST_F(OutboxTest, FailsWhereTheMachineLacksTheMemory) {
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  const rlimit less{topology::process_memory().addresses + (1 << 20), before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &less), 0);
  EXPECT_THROW(Outbox(kWidth, 1), Failure) << "a strip takes more than 1 MiB";
  setrlimit(RLIMIT_AS, &before);
}

}  // namespace
}  // namespace mars::group
