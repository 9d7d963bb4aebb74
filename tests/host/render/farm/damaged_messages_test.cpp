// Damaged messages: whatever a node sends, the inbox refuses it with one failure that names the node, or it can be used
// to the last byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "hal/nx/nx_messages.h"
#include "hal/threads/run_threads.h"
#include "host/render/compositor/compositor.h"
#include "host/render/farm/node_inbox.h"
#include "host/render/trace/trace_file.h"
#include "tests/host/render/farm/scripted_node.h"
#include "tests/temporary_folder.h"

namespace mars::farm {
namespace {

constexpr int kMessages = 3000;  // of each type
constexpr std::uint32_t kDamagedWidth = 16, kDamagedHeight = 8;

using Bytes = std::vector<std::byte>;

template <typename Message>
Bytes bytes_of(const Message& message) {
  Bytes bytes(sizeof message);
  std::memcpy(bytes.data(), &message, sizeof message);
  return bytes;
}

class Damage {
 public:
  // Some of its bytes and words changed; now and then also its length, where that may be.
  Bytes damaged(Bytes message, bool length_too = true) {
    for (int changes = below(4); changes >= 0; --changes) change(message);
    if (length_too && below(8) == 0)
      message.resize(static_cast<std::size_t>(below(static_cast<int>(2 * message.size()) + 2)));
    if (below(50) == 0)
      for (std::byte& byte : message) byte = static_cast<std::byte>(below(256));
    return message;
  }

 private:
  int below(int bound) { return std::uniform_int_distribution(0, bound - 1)(random_); }

  void change(Bytes& message) {
    if (message.empty()) return;
    const auto at = static_cast<std::size_t>(below(static_cast<int>(message.size())));
    if (below(2) == 0) {
      message[at] ^= static_cast<std::byte>(1 << below(8));
      return;
    }
    constexpr std::array<std::uint32_t, 12> words{0,      1,       2,          7,          8,       16,
                                                  0xffff, 0x10000, 0x7fffffff, 0x80000000, ~0u - 1, ~0u};
    const std::uint32_t word = words[static_cast<std::size_t>(below(static_cast<int>(words.size())))];
    const std::size_t aligned = at / 4 * 4;
    std::memcpy(message.data() + aligned, &word, std::min(sizeof word, message.size() - aligned));
  }

  std::mt19937 random_{7};
};

// One line that says whose it is.
void expect_clear(const Failure& failure) {
  const std::string text = failure.what();
  EXPECT_NE(text.find("node 0"), std::string::npos) << text;
  for (const unsigned char c : text) EXPECT_TRUE(c >= ' ' && c != 127) << text;
}

// The only node sends `sound`, then damaged copies, one at a time; the host receives each.
struct Exchange {
  long type;
  Bytes sound;
  std::function<void()> receive;
  std::function<void()> ask = [] { csend(wire::kCredit, nullptr, 0, 0, 0); };  // the host, for the next
  std::function<void(const Bytes&)> send = [type = type](const Bytes& message) {
    csend(type, message.data(), static_cast<long>(message.size()), myhost(), 0);
  };
  std::function<void()> boot_node = [] {};
  std::function<void()> boot_host = [] {};
};

// How many were refused.
int refused_of(const Exchange& exchange) {
  int refused = 0;
  const auto node = [&] {
    Damage damage;
    exchange.boot_node();
    for (int i = 0; i <= kMessages; ++i) {
      ScriptedNode::receive(wire::kCredit);
      exchange.send(i == 0 ? exchange.sound : damage.damaged(exchange.sound));
    }
  };
  const auto host = [&] {
    exchange.boot_host();
    for (int i = 0; i <= kMessages; ++i) {
      exchange.ask();
      cprobe(exchange.type);
      try {
        exchange.receive();
      } catch (const Failure& failure) {
        EXPECT_GT(i, 0) << "the sound one: " << failure.what();
        expect_clear(failure);
        ++refused;
      }
      if (iprobe(exchange.type)) ScriptedNode::receive(exchange.type);
    }
  };
  threads::run_threads(1, host, node);
  return refused;
}

int refused_of(long type, const Bytes& sound, const std::function<void()>& receive) {
  return refused_of(Exchange{type, sound, receive});
}

wire::Hello sound_hello() {
  wire::Hello hello{};
  hello.stamp = wire::own_stamp();
  hello.host = {"n0"};
  hello.memory = 1 << 20;
  hello.simd = {"avx2"};
  return hello;
}

// The host's, with one node that has one slot.
struct Inbox {
  explicit Inbox(wire::PixelFormat format = wire::PixelFormat::rgb8)
      : inbox(kDamagedWidth, kDamagedHeight, format, slots, nullptr) {}

  NodeSlots slots{1, 1};
  NodeInbox inbox;
};

TEST(DamagedMessages, Hello) {
  EXPECT_GT(refused_of(wire::kHello, bytes_of(sound_hello()), [] { Inbox().inbox.receive_hellos(); }), kMessages / 10);
}

TEST(DamagedMessages, Loaded) {
  refused_of(wire::kLoaded, bytes_of(wire::Loaded{}), [] { Inbox().inbox.wait_until_loaded(); });
}

constexpr wire::PixelFormat kFormats[] = {wire::PixelFormat::rgb8, wire::PixelFormat::half};

Bytes sound_strip_message(std::uint32_t by_message, wire::PixelFormat format) {
  wire::Strip header{};
  header.last = 1;
  header.last_line = kDamagedHeight;
  header.by_message = by_message;
  StripStore store;
  const std::size_t words = wire::pixel_words(format);
  const StripBytes strip = strip_bytes(header, {{{0, 1, 2}, {1, 0, 16}}, std::vector<std::uint32_t>(18 * words, 5)},
                                       {{{3, 0, 3}}, std::vector<std::uint32_t>(3 * words, 6)}, store, format);
  return {strip.data.get(), strip.data.get() + strip.size};
}

void paste(const StripMessage& message, wire::PixelFormat format) {
  compositor::Compositor compositor(kDamagedWidth, kDamagedHeight, 8, format);
  compositor::Frame frame(kDamagedWidth, kDamagedHeight, 8, 0, format);
  compositor.begin_frame(frame);
  compositor.paste_constant(message.constant_runs(), message.constant_pixels(), &frame);
  compositor.paste_moving(frame, message.moving_runs(), message.moving_pixels());
}

TEST(DamagedMessages, Strip) {
  for (const wire::PixelFormat format : kFormats) {
    StripStore store;
    std::optional<Inbox> host;
    Exchange exchange{wire::kStrip, sound_strip_message(1, format),
                      [&] { paste(*host->inbox.receive_strip(store), format); }};
    exchange.ask = [&] {
      host.emplace(format);
      host->slots.give({0, 0});
    };
    EXPECT_GT(refused_of(exchange), kMessages / 10);
  }
}

// The node damages its slot once more when the host has checked the strip.
void expect_refusals_of_slots(wire::PixelFormat format) {
  StripStore store;
  std::optional<Inbox> host;
  std::optional<messages::OfferedMemory> slot;  // the node's
  Damage later;
  Exchange exchange{wire::kStrip, sound_strip_message(0, format), [&] {
                      const StripMessage strip = *host->inbox.receive_strip(store);
                      const auto bytes = slot->bytes().first(1000);
                      std::ranges::copy(later.damaged({bytes.begin(), bytes.end()}, false), bytes.begin());
                      paste(strip, format);
                    }};
  exchange.ask = [&] {
    host->slots.take({0, 0});  // where the last was refused before that
    host->slots.give({0, 0});
  };
  exchange.send = [&](const Bytes& strip) {
    std::ranges::copy(strip, slot->bytes().begin());
    csend(wire::kStrip, strip.data(), static_cast<long>(std::min(strip.size(), sizeof(wire::Strip))), myhost(), 0);
  };
  exchange.boot_node = [&] {
    slot.emplace(wire::kSlotBytes);
    ScriptedNode::send(wire::kLoaded, wire::Loaded{slot->name(), {}});
  };
  exchange.boot_host = [&] {
    host.emplace(format);
    host->inbox.wait_until_loaded();
  };
  EXPECT_GT(refused_of(exchange), kMessages / 10);
}

TEST(DamagedMessages, StripInASlot) {
  for (const wire::PixelFormat format : kFormats) expect_refusals_of_slots(format);
}

TEST(DamagedMessages, Fault) {
  wire::Fault fault{};
  fault.reason = {"no memory"};
  refused_of(wire::kFault, bytes_of(fault), [] {
    try {
      Inbox().inbox.receive_fault();
    } catch (const NodeFailure& failure) {
      expect_clear(failure);
    }
  });
}

TEST(DamagedMessages, Clock) {
  trace::NodeClock clock;
  refused_of(wire::kClock, bytes_of(5.0),
             [&] { clock.add(trace::ClockReading::of(4, Inbox().inbox.receive_time(0), 6)); });
  EXPECT_TRUE(std::isfinite(clock.to_host(5)) && std::isfinite(clock.error()));
}

TEST(DamagedMessages, Trace) {
  using Kind = messages::Event::Kind;
  std::vector<messages::Event> events(4);
  events[0] = {1, 2, 3, Kind::span, 1, -1, 0, 0, 0};
  events[1] = {1, 2, 3, Kind::sent, wire::kStrip, 1, 0, 0, 0};
  events[2] = {1, 2, 3, Kind::waited, -1, -1, 0, 0, 0};
  events[3].kind = Kind::lost;
  Bytes sound(events.size() * sizeof events[0]);
  std::memcpy(sound.data(), events.data(), sound.size());
  trace::Trace trace;
  trace.begin(std::vector{sound_hello()}, 0);
  EXPECT_GT(refused_of(wire::kTrace, sound, [&] { trace.add(0, Inbox().inbox.receive_events()); }), kMessages / 10);
  const test::TemporaryFolder folder;
  trace::write_trace(folder.path() / "trace.json", {"film", "threads"}, trace);
}

}  // namespace
}  // namespace mars::farm
