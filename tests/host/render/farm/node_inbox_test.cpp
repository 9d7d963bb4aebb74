// Messages that no sound node sends: each is one clear failure that names the node and its machine, and nothing of it
// is used.
#include "host/render/farm/node_inbox.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <tuple>

#include "tests/host/content/document/failure_of.h"
#include "tests/host/render/farm/scripted_node.h"
#include "node/wire/greeting.h"

namespace mars::farm {
namespace {

const EmptyFilm& film() {
  static const EmptyFilm film({4});
  return film;
}

// What the host says when node 1 of two does this while node 0 does all it should.
std::string failure_with(const std::function<void()>& bad_node, bool traced = false) {
  ScriptedRun run;
  trace::Trace trace;
  run.nodes = 2;
  run.work = {frames_to(4)};
  if (traced) run.farm.trace = &trace;
  return document::failure_of([&] {
    run.render(film(), [&] {
      if (mynode() == 1) return bad_node();
      ScriptedNode node;
      node.boot();
      node.draw_all();
    });
  });
}

void send_bytes(long type, const void* data, std::size_t bytes) {
  csend(type, data, static_cast<long>(bytes), myhost(), 0);
}

// A greeting, spoilt.
template <typename Spoil>
std::string failure_greeting(const Spoil& spoil) {
  return failure_with([&] {
    wire::Hello hello = ScriptedNode::hello();
    spoil(hello);
    ScriptedNode::send(wire::kHello, hello);
    ScriptedNode::receive(wire::kStop);
  });
}

TEST(Greeting, AnotherVersionIsNamedByItsMachine) {
  const std::string failure = failure_greeting([](wire::Hello& hello) {
    hello.stamp.release = {0, 1, 0};
    hello.stamp.wire = 1;
    hello.host = {"old-machine"};
  });
  const wire::WireStamp own = wire::own_stamp();
  const std::string version =
      std::to_string(own.release[0]) + "." + std::to_string(own.release[1]) + "." + std::to_string(own.release[2]);
  EXPECT_EQ(failure, "old-machine (node 1) runs MARS 0.1.0 (wire 1), the host runs MARS " + version + " (wire " +
                         std::to_string(own.wire) + ") (install the same MARS on all machines)");
}

TEST(Greeting, AnotherVersionsIsNotReadFurther) {
  const std::string failure = failure_with([] {
    std::vector<std::byte> message(200, std::byte{0xff});
    wire::Hello hello = ScriptedNode::hello();
    ++hello.stamp.wire;
    std::memcpy(message.data(), &hello, offsetof(wire::Hello, node));
    send_bytes(wire::kHello, message.data(), message.size());
    ScriptedNode::receive(wire::kStop);
  });
  EXPECT_TRUE(document::holds(failure, "n1 (node 1) runs MARS")) << failure;
}

// As 0.1.0 sends it, at home in 184 bytes: node, machine, rank, seat and memory stand before the name.
TEST(Greeting, OfAVersionBeforeStampsIsNamedByItsMachine) {
  const std::string failure = failure_with([] {
    std::vector<std::byte> message(184, std::byte{0xff});
    std::memcpy(message.data() + 40, "old-machine", sizeof "old-machine");
    send_bytes(wire::kHello, message.data(), message.size());
    ScriptedNode::receive(wire::kStop);
  });
  EXPECT_TRUE(document::holds(failure, "old-machine (node 1) is not MARS, or of a version before 0.2.0")) << failure;
}

TEST(Greeting, IsOfTheSameBuild) {
  EXPECT_TRUE(
      document::holds(failure_greeting([](wire::Hello& hello) { hello.stamp.magic[2] ^= 1; }), "node 1 is not MARS"));
  EXPECT_TRUE(document::holds(failure_greeting([](wire::Hello& hello) { hello.stamp.byte_order = 0x04030201; }),
                              "use machines of one byte order"));
  EXPECT_TRUE(
      document::holds(failure_greeting([](wire::Hello& hello) { ++hello.stamp.sizes; }), "messages of other sizes"));
  EXPECT_TRUE(
      document::holds(failure_greeting([](wire::Hello& hello) { ++hello.stamp.release[2]; }), "n1 (node 1) runs MARS"));
}

TEST(Greeting, CutOffAnywhere) {
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{3}, sizeof(wire::WireStamp) - 1, sizeof(wire::WireStamp),
                                  sizeof(wire::Hello) - 1, sizeof(wire::Hello) + 1}) {
    const std::string failure = failure_with([bytes] {
      std::vector<std::byte> message(sizeof(wire::Hello) + 1);
      const wire::Hello hello = ScriptedNode::hello();
      std::memcpy(message.data(), &hello, sizeof hello);
      send_bytes(wire::kHello, message.data(), bytes);
      ScriptedNode::receive(wire::kStop);
    });
    const bool too_short = bytes < sizeof(wire::WireStamp);
    EXPECT_TRUE(document::holds(failure, too_short ? "node 1 is not MARS" : "node 1: sent a greeting of another size"))
        << failure;
  }
}

TEST(Greeting, SaysOnlyWhatIsTrue) {
  EXPECT_TRUE(document::holds(failure_greeting([](wire::Hello& hello) { hello.node = 0; }), "another node's greeting"));
  EXPECT_TRUE(
      document::holds(failure_greeting([](wire::Hello& hello) { hello.machine = 7; }), "a machine that is not there"));
  EXPECT_TRUE(
      document::holds(failure_greeting([](wire::Hello& hello) { hello.machine = -1; }), "a machine that is not there"));
  EXPECT_TRUE(
      document::holds(failure_greeting([](wire::Hello& hello) { hello.simd.fill('x'); }), "names that are no text"));
}

TEST(Greeting, ComesOnce) {
  ScriptedRun run;
  run.nodes = 2;
  run.work = {frames_to(4)};
  const std::string failure = document::failure_of([&] {
    run.render(film(), [] {
      for (int i = 0; mynode() == 1 && i < 2; ++i) ScriptedNode::send(wire::kHello, ScriptedNode::hello());
      ScriptedNode::receive(wire::kStop);
    });
  });
  EXPECT_TRUE(document::holds(failure, "n1 (node 1): sent another node's greeting")) << failure;
}

TEST(Inbox, WordOfTheFilmOfAnotherSize) {
  const std::string failure = failure_with([] {
    ScriptedNode node;
    ScriptedNode::send(wire::kHello, ScriptedNode::hello());
    node.take_load();
    ScriptedNode::send(wire::kLoaded, std::int32_t{1});
    ScriptedNode::receive(wire::kStop);
  });
  EXPECT_TRUE(document::holds(failure, "n1 (node 1): sent word of the film")) << failure;
}

// A strip for the keyframe of node 1.
StripBytes sound_strip(const ScriptedNode::Command& command, const wire::Credit& credit, StripStore& store) {
  wire::Strip header = ScriptedNode::strip_of(command, command.frames.front());
  header.slot = credit.slot;
  header.by_message = credit.by_message;
  return strip_bytes(header, {{{0, 1, 2}}, {1, 2}}, {{{3, 0, 1}}, {3}}, store);
}

// It comes by message; `spoil` changes that.
using Bytes = std::vector<std::byte>;
std::string failure_of_strip(const std::function<void(Bytes&, wire::Strip&)>& spoil) {
  return failure_with([&] {
    ScriptedNode node(false);
    node.boot();
    const auto command = node.next_command();
    StripStore store;
    const StripBytes strip = sound_strip(*command, node.next_credit(), store);
    Bytes bytes(strip.data.get(), strip.data.get() + strip.size);
    wire::Strip header;
    std::memcpy(&header, bytes.data(), sizeof header);
    spoil(bytes, header);
    std::memcpy(bytes.data(), &header, std::min(bytes.size(), sizeof header));
    send_bytes(wire::kStrip, bytes.data(), bytes.size());
    while (node.next_command()) {
    }
  });
}

void expect_refused(const std::string& what, const std::function<void(Bytes&, wire::Strip&)>& spoil) {
  const std::string failure = failure_of_strip(spoil);
  EXPECT_EQ(failure, "n1 (node 1): sent " + what + " (please report it)");
}

// It comes by slot; `send` sends what should be its header, after changes to what lies in the slot.
std::string failure_of_slot(const std::function<void(ScriptedNode&, std::span<std::byte>, wire::Strip)>& send) {
  return failure_with([&] {
    ScriptedNode node;
    node.boot();
    const auto command = node.next_command();
    StripStore store;
    const wire::Credit credit = node.next_credit();
    const StripBytes strip = sound_strip(*command, credit, store);
    std::copy_n(strip.data.get(), strip.size, node.slot(credit.slot).begin());
    wire::Strip header;
    std::memcpy(&header, strip.data.get(), sizeof header);
    send(node, node.slot(credit.slot).first(strip.size), header);
    while (node.next_command()) {
    }
  });
}

TEST(Inbox, StripsOfAnotherSize) {
  expect_refused("a strip of an impossible size", [](Bytes& bytes, wire::Strip&) { bytes.clear(); });
  expect_refused("a strip of an impossible size",
                 [](Bytes& bytes, wire::Strip&) { bytes.resize(sizeof(wire::Strip) - 1); });
  expect_refused("a strip of an impossible size", [](Bytes& bytes, wire::Strip& strip) {
    bytes.resize(wire::kMaxStripBytes + 4);
    strip.pixels += (bytes.size() - sizeof strip) / 4 - strip.pixels;
  });
  const std::string broken = "a strip that is not what its header says";
  expect_refused(broken, [](Bytes& bytes, wire::Strip&) { bytes.resize(sizeof(wire::Strip)); });
  expect_refused(broken, [](Bytes& bytes, wire::Strip&) { bytes.push_back({}); });
  expect_refused(broken, [](Bytes&, wire::Strip& strip) { strip.pixels = ~std::uint64_t{0}; });
  expect_refused(broken, [](Bytes&, wire::Strip& strip) { strip.moving_runs = 0x80000000; });
  expect_refused(broken, [](Bytes&, wire::Strip& strip) { strip.kind = static_cast<wire::FrameKind>(7); });
}

// The second run's place and count, as they lie in the message.
void spoil_run(Bytes& bytes, const wire::Run& run) {
  std::memcpy(bytes.data() + bytes.size() - sizeof run, &run, sizeof run);
}

TEST(Inbox, StripsThatDrawWhereTheyMustNot) {
  expect_refused("pixels outside the picture", [](Bytes& bytes, wire::Strip&) { spoil_run(bytes, {3, 16, 1}); });
  expect_refused("pixels outside the picture", [](Bytes& bytes, wire::Strip&) { spoil_run(bytes, {3, 65535, 1}); });
  expect_refused("pixels outside the strip's lines", [](Bytes& bytes, wire::Strip&) { spoil_run(bytes, {8, 0, 1}); });
  expect_refused("pixels outside the strip's lines", [](Bytes& bytes, wire::Strip&) { spoil_run(bytes, {~0u, 0, 1}); });
  expect_refused("pixels outside the strip's lines", [](Bytes&, wire::Strip& strip) { strip.last_line = 3; });
  expect_refused("lines outside the picture", [](Bytes&, wire::Strip& strip) { strip.last_line = 9; });
  expect_refused("lines outside the picture",
                 [](Bytes&, wire::Strip& strip) { strip.first_line = 8, strip.last_line = 0; });
  // A run of nothing: as many pixels as the runs count.
  expect_refused("pixels outside the picture", [](Bytes& bytes, wire::Strip& strip) {
    spoil_run(bytes, {3, 0, 0});
    bytes.erase(bytes.begin() + sizeof strip, bytes.begin() + sizeof strip + 4);
    --strip.pixels;
  });
}

void expect_slot_refused(const std::string& what,
                         const std::function<void(std::span<std::byte> slot, wire::Strip& header)>& spoil) {
  const std::string failure = failure_of_slot([&](ScriptedNode&, std::span<std::byte> slot, wire::Strip header) {
    spoil(slot, header);
    ScriptedNode::send(wire::kStrip, header);
  });
  EXPECT_EQ(failure, "n1 (node 1): sent " + what + " (please report it)");
}

TEST(Inbox, StripsInSlotsOfAnotherSize) {
  for (const std::size_t bytes : {std::size_t{0}, sizeof(wire::Strip) - 1, sizeof(wire::Strip) + 1}) {
    const std::string failure =
        failure_of_slot([bytes](ScriptedNode&, std::span<std::byte>, const wire::Strip& header) {
          Bytes message(sizeof header + 1);
          std::memcpy(message.data(), &header, sizeof header);
          send_bytes(wire::kStrip, message.data(), bytes);
        });
    EXPECT_EQ(failure, "n1 (node 1): sent a strip of an impossible size (please report it)");
  }
  const std::string broken = "a strip that is not what its header says";
  expect_slot_refused(broken, [](auto, wire::Strip& strip) { strip.pixels = ~std::uint64_t{0}; });
  expect_slot_refused(broken, [](auto, wire::Strip& strip) { strip.pixels = wire::kSlotBytes / 4; });
  expect_slot_refused(broken, [](auto, wire::Strip& strip) { strip.moving_runs = 0x80000000; });
  expect_slot_refused(broken, [](auto, wire::Strip& strip) { strip.by_message = 1; });
  expect_slot_refused(broken, [](std::span<std::byte> slot, wire::Strip&) {
    const wire::Run run{3, 0, 2};
    std::memcpy(slot.last(sizeof run).data(), &run, sizeof run);
  });
}

TEST(Inbox, StripsInSlotsThatDrawWhereTheyMustNot) {
  const auto put_run = [](std::span<std::byte> slot, const wire::Run& run) {
    std::memcpy(slot.last(sizeof run).data(), &run, sizeof run);
  };
  expect_slot_refused("pixels outside the picture", [&](std::span<std::byte> slot, wire::Strip&) {
    put_run(slot, {3, 16, 1});
  });
  expect_slot_refused("pixels outside the strip's lines", [&](std::span<std::byte> slot, wire::Strip&) {
    put_run(slot, {~0u, 0, 1});
  });
}

TEST(Inbox, StripsInSlotsThatAreNotTheNodes) {
  const std::string taken = "a strip in a slot that it does not have";
  expect_slot_refused(taken, [](auto, wire::Strip& strip) { strip.slot = wire::kMaxCredits; });
  expect_slot_refused(taken, [](auto, wire::Strip& strip) { strip.slot = ~0u; });
  expect_refused(taken, [](Bytes&, wire::Strip& strip) { strip.slot = ~0u; });
}

// An inbetween's, which waits for the keyframe.
TEST(Inbox, TheSlotOfAStripThatCameIsTheHosts) {
  for (const bool seen : {true, false}) {
    const std::string failure = failure_with([seen] {
      ScriptedNode node(seen);
      node.boot();
      const auto command = node.next_command();
      wire::Strip header = ScriptedNode::strip_of(*command, ScriptedNode::own_frames(*command).at(1));
      header.last = 0;
      const wire::Credit credit = node.credits.front();
      node.send_strip(header, 1);
      node.credits.push_front(credit);
      node.send_strip(header, 1);
      ScriptedNode::receive(wire::kStop);
    });
    EXPECT_EQ(failure, "n1 (node 1): sent a strip in a slot that it does not have (please report it)");
  }
}

TEST(Inbox, StripsThatNobodyAskedFor) {
  expect_refused("another node's strip", [](Bytes&, wire::Strip& strip) { strip.node = 0; });
  expect_refused("another node's strip", [](Bytes&, wire::Strip& strip) { strip.node = 1000; });
  expect_slot_refused("another node's strip", [](auto, wire::Strip& strip) { strip.node = 0; });
  expect_refused("a strip of frame 9 that it was not asked for", [](Bytes&, wire::Strip& strip) { strip.frame = 9; });
  expect_refused("a strip of frame 0 that it was not asked for",
                 [](Bytes&, wire::Strip& strip) { strip.interval = 3; });
  expect_refused("a strip that is neither the last nor another", [](Bytes&, wire::Strip& strip) { strip.last = 2; });
}

TEST(Inbox, FaultsOfAnotherSize) {
  const std::string failure = failure_with([] {
    ScriptedNode node;
    node.boot();
    ScriptedNode::send(wire::kFault, std::int32_t{3});
    ScriptedNode::receive(wire::kStop);
  });
  EXPECT_TRUE(document::holds(failure, "n1 (node 1): sent a fault of an impossible size")) << failure;
}

// The reason has no end, the frame and the node are nonsense.
TEST(Inbox, AFaultIsOfItsSender) {
  const std::string failure = failure_with([] {
    ScriptedNode node;
    node.boot();
    wire::Fault fault{};
    fault.node = 77;
    fault.frame = -5;
    fault.reason.fill('x');
    ScriptedNode::send(wire::kFault, fault);
    ScriptedNode::receive(wire::kStop);
  });
  EXPECT_EQ(failure, "node 1: " + std::string(sizeof wire::Fault::reason - 1, 'x'));
}

TEST(Inbox, AFaultIsOneLine) {
  const std::string failure = failure_with([] {
    ScriptedNode node;
    node.boot();
    wire::Fault fault{};
    fault.frame = -1;
    fault.reason = {"no\nmemory\x1b[31m"};
    ScriptedNode::send(wire::kFault, fault);
    ScriptedNode::receive(wire::kStop);
  });
  EXPECT_EQ(failure, "node 1: no memory [31m");
}

TEST(Inbox, EventsOfARunThatIsNotTraced) {
  const std::string failure = failure_with([] {
    ScriptedNode node;
    node.boot();
    messages::Event end{};
    end.kind = messages::Event::Kind::lost;
    ScriptedNode::send(wire::kTrace, end);
    ScriptedNode::receive(wire::kStop);
  });
  EXPECT_TRUE(document::holds(failure, "events of a run that is not traced")) << failure;
}

// Of a run whose host composes the frames.
TEST(Inbox, WordOfFramesThatNodesWereNotToWrite) {
  const auto failure_of = [](long type, auto message_of) {
    return failure_with([type, message_of] {
      ScriptedNode node;
      node.boot();
      ScriptedNode::send(type, message_of(*node.next_command()));
      ScriptedNode::receive(wire::kStop);
    });
  };
  const std::string drawn = failure_of(wire::kDrawn, [](const ScriptedNode::Command& command) {
    return ScriptedNode::strip_of(command, command.frames.front());
  });
  EXPECT_TRUE(document::holds(drawn, "a strip of frame 0 that it was not asked for")) << drawn;
  const std::string written = failure_of(wire::kWritten, [](const ScriptedNode::Command& command) {
    return wire::Written{command.frames.front(), static_cast<std::int32_t>(mynode()), {}, 0, 0};
  });
  EXPECT_TRUE(document::holds(written, "word of a file that it was not asked for")) << written;
}

// What node 1 of a traced run sends.
std::string failure_of_events(const std::vector<messages::Event>& events, std::size_t bytes_less = 0) {
  return failure_with(
      [&] {
        ScriptedNode node;
        node.boot();
        send_bytes(wire::kTrace, events.data(), events.size() * sizeof(messages::Event) - bytes_less);
        ScriptedNode::receive(wire::kStop);
      },
      true);
}

TEST(Inbox, EventsThatMakeNoSense) {
  using Kind = messages::Event::Kind;
  messages::Event end{}, event{};
  end.kind = Kind::lost;
  const auto refused = [&](const std::vector<messages::Event>& events, std::size_t bytes_less = 0) {
    return document::holds(failure_of_events(events, bytes_less), "n1 (node 1): sent events ");
  };
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused({event, end}, 1));
  EXPECT_TRUE(refused({end, event})) << "what ends them comes last";
  EXPECT_TRUE(refused({end, end}));
  for (const auto& [kind, what, peer] : {std::tuple{Kind::span, static_cast<int>(wire::Phase::inbetween) + 1, 0},
                                         {Kind::span, -1, 0},
                                         {Kind::sent, 1, 3},
                                         {Kind::taken, 1, -1},
                                         {Kind::waited, -2, 0},
                                         {static_cast<Kind>(9), 0, 0}}) {
    event.kind = kind;
    event.what = what;
    event.peer = peer;
    EXPECT_TRUE(refused({event, end})) << static_cast<int>(kind) << " " << what << " " << peer;
  }
}

TEST(Inbox, TimesOfAnotherSize) {
  const std::string failure = failure_with(
      [] {
        ScriptedNode::send(wire::kHello, ScriptedNode::hello());
        ScriptedNode::receive(wire::kClock);
        ScriptedNode::send(wire::kClock, 1.0f);
        ScriptedNode::receive(wire::kStop);
      },
      true);
  EXPECT_TRUE(document::holds(failure, "n1 (node 1): sent a time of an impossible size")) << failure;
}

}  // namespace
}  // namespace mars::farm
