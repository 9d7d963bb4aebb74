// Strips to a host that gives slots, and a transport that is done with messages, when the test says so.
#include "node/group/outbox.h"

#include <gtest/gtest.h>

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
    std::size_t length;
    const void* data;
    bool gone = false;
  };

  bool has_host() const override { return true; }
  messages::Offer offer(std::size_t bytes) override {
    return memory_is_shared ? TemplateBackend::offer(bytes) : messages::Offer{};
  }
  messages::Ticket start_send(int to, int type, const void* data, std::size_t length) override {
    Sent message{to, type, {}, length, data, transport_is_quick};
    EXPECT_GE(length, sizeof message.strip);
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
  void give(std::uint32_t slot, std::uint32_t by_message = 0) {
    const wire::Credit credit{slot, by_message};
    send(rank(), wire::kCredit, &credit, sizeof credit);
  }
  void give_all(std::uint32_t slots) {
    for (std::uint32_t slot = 0; slot < slots; ++slot) give(slot);
  }
  void stop() { send(rank(), wire::kStop, nullptr, 0); }

  std::vector<Sent> messages;
  std::deque<std::function<void()>> script;
  bool memory_is_shared = true;
  bool transport_is_quick = true;  // else messages are gone when the test sets it
  int waits = 0;
};

class OutboxTest : public testing::Test {
 protected:
  // The header as the outbox leaves it. The strip has one pixel.
  wire::Strip send(Outbox& outbox) {
    wire::Strip header{};
    header.number = static_cast<std::uint32_t>(host.messages.size());
    raster::StripBuffer& strip = outbox.begin(kWidth, false, header.work);
    const std::uint32_t pixel = 1000 + header.number;
    std::memcpy(strip.moving().next_pixel(), &pixel, sizeof pixel);
    *strip.moving().next_run() = {header.number, 0, 1};
    strip.moving().added({1, 1});
    outbox.send(header);
    return header;
  }

  ScriptedHost host;
  messages::Process process{host};
};

TEST_F(OutboxTest, SendsAStripInEachSlotThatIsGiven) {
  Outbox outbox(wire::PixelFormat::rgb8, 3, {});
  host.give_all(3);
  for (std::uint32_t number = 0; number < 3; ++number) {
    EXPECT_EQ(send(outbox).work.credits_waited, 0u);
    const ScriptedHost::Sent& message = host.messages.at(number);
    EXPECT_EQ(message.to, host.host());
    EXPECT_EQ(message.type, wire::kStrip);
    EXPECT_EQ(message.strip.number, number);
    EXPECT_EQ(message.strip.slot, number);
  }
  EXPECT_EQ(host.waits, 0);
}

TEST_F(OutboxTest, AllSlotsAreTheHostsAtFirst) {
  Outbox outbox(wire::PixelFormat::rgb8, 2, {});
  host.script = {[&] { host.give(1); }};
  EXPECT_EQ(send(outbox).work.credits_waited, 1u);
  EXPECT_EQ(host.messages.back().strip.slot, 1u);
}

// Pixels and runs lie in the slot, which the name names; or they travel.
TEST_F(OutboxTest, AStripGoesAsItsCreditSays) {
  Outbox outbox(wire::PixelFormat::rgb8, 2, {});
  host.give(1);
  EXPECT_GT(send(outbox).work.bytes_to_host, sizeof(wire::Strip)) << "by slot as by message";
  const ScriptedHost::Sent by_slot = host.messages.back();
  EXPECT_EQ(by_slot.length, sizeof(wire::Strip));
  EXPECT_EQ(by_slot.strip.by_message, 0u);
  host.give(0, 1);
  const wire::Strip header = send(outbox);
  const ScriptedHost::Sent& by_message = host.messages.back();
  EXPECT_EQ(by_message.length, header.work.bytes_to_host);
  EXPECT_EQ(by_message.strip.by_message, 1u);
  const auto* slots = static_cast<const std::byte*>(by_message.data);
  EXPECT_EQ(static_cast<const std::byte*>(by_slot.data), slots + wire::kSlotBytes);
  std::uint32_t pixel = 0;
  std::memcpy(&pixel, slots + wire::kSlotBytes + sizeof(wire::Strip), sizeof pixel);
  EXPECT_EQ(pixel, 1000u);
}

TEST_F(OutboxTest, WhereNoMemoryIsSharedStripsGoByMessage) {
  host.memory_is_shared = false;
  Outbox outbox(wire::PixelFormat::rgb8, 1, {});
  EXPECT_FALSE(messages::AttachedMemory::attach(host.rank(), outbox.slots(), wire::kSlotBytes));
  host.give(0, 1);
  const wire::Strip header = send(outbox);
  EXPECT_EQ(header.work.bytes_to_host, host.messages.back().length);
}

TEST_F(OutboxTest, WaitsForCreditAndSaysSo) {
  Outbox outbox(wire::PixelFormat::rgb8, 1, {});
  host.give(0);
  send(outbox);
  host.script = {[] {}, [&] { host.give(0); }};
  const wire::Strip header = send(outbox);
  EXPECT_EQ(host.waits, 2);
  EXPECT_EQ(header.work.credits_waited, 1u);
  EXPECT_EQ(host.messages.back().strip.work.credits_waited, 1u) << "the strip says so to the host";
  EXPECT_EQ(host.messages.size(), 2u);
}

TEST_F(OutboxTest, TakesWhatCreditHasCome) {
  Outbox outbox(wire::PixelFormat::rgb8, 3, {});
  host.give_all(3);
  for (int k = 0; k < 3; ++k) send(outbox);
  host.give_all(3);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(send(outbox).work.credits_waited, 0u);
  EXPECT_THROW(send(outbox), Failure) << "a seventh has none";
  EXPECT_EQ(host.messages.size(), 6u);
}

TEST_F(OutboxTest, RefusesASlotThatItHas) {
  Outbox outbox(wire::PixelFormat::rgb8, 2, {});
  host.give(0);
  host.give(0);
  EXPECT_THROW(send(outbox), Failure);
}

TEST_F(OutboxTest, ReceivesCreditWhileNothingIsSent) {
  Outbox outbox(wire::PixelFormat::rgb8, 1, {});
  host.script = {[&] { host.give(0); }};
  outbox.receive_credit();
  EXPECT_EQ(send(outbox).work.credits_waited, 0u);
  EXPECT_EQ(host.waits, 1);
}

// Though there is credit: a slot is not touched before its message has left it.
TEST_F(OutboxTest, ReusesASlotWhenItsMessageIsGone) {
  Outbox outbox(wire::PixelFormat::rgb8, 2, {});
  host.transport_is_quick = false;
  host.give_all(2);
  send(outbox);
  send(outbox);
  host.give_all(2);
  host.script = {[&] { host.messages[1].gone = true; }, [&] { host.messages[0].gone = true; }};
  send(outbox);
  EXPECT_EQ(host.waits, 2) << "the first slot's turn, not the second's";
  send(outbox);
  EXPECT_EQ(host.waits, 2) << "the second is free already";
}

// Lines are still drawn for the others of the group, in a slot that the host no longer uses.
TEST_F(OutboxTest, AfterStopItNeitherWaitsForCreditNorSends) {
  Outbox outbox(wire::PixelFormat::rgb8, 1, {});
  host.give(0);
  send(outbox);
  EXPECT_FALSE(outbox.stopped());
  host.stop();
  send(outbox);
  EXPECT_TRUE(outbox.stopped());
  EXPECT_EQ(host.messages.size(), 1u);
  EXPECT_EQ(host.waits, 0);
}

TEST_F(OutboxTest, StopEndsTheWaitForCredit) {
  Outbox outbox(wire::PixelFormat::rgb8, 1, {});
  host.script = {[&] { host.stop(); }};
  send(outbox);
  EXPECT_TRUE(outbox.stopped());
  EXPECT_TRUE(host.messages.empty());
}

TEST_F(OutboxTest, FlushWaitsUntilAllIsGone) {
  Outbox outbox(wire::PixelFormat::rgb8, 3, {});
  host.transport_is_quick = false;
  host.give_all(3);
  send(outbox);
  send(outbox);
  host.script = {[&] { host.messages[1].gone = true; }, [&] { host.messages[0].gone = true; }};
  outbox.flush();
  EXPECT_EQ(host.waits, 2);
  outbox.flush();
  EXPECT_EQ(host.waits, 2) << "nothing is left";
}

TEST_F(OutboxTest, AFailureOfTheTransportComesThrough) {
  Outbox outbox(wire::PixelFormat::rgb8, 1, {});
  host.give(0);
  send(outbox);
  host.script = {[] { throw Failure("the host is gone", "", ""); }};
  EXPECT_THROW(send(outbox), Failure);
  EXPECT_EQ(host.messages.size(), 1u);
}

}  // namespace
}  // namespace mars::group
