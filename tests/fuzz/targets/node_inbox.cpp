// What nodes send, message by message: the input says which message comes and how a sound one is changed. The host
// refuses it, or can use it to the last byte.
#include <algorithm>
#include <array>
#include <functional>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "host/render/compositor/compositor.h"
#include "host/render/farm/node_inbox.h"
#include "host/render/trace/trace.h"
#include "node/wire/greeting.h"
#include "tests/fuzz/dead_peers.h"
#include "tests/fuzz/target.h"
#include "tests/host/render/farm/strips.h"

namespace mars::fuzz::node_inbox {
namespace {

using wire::PixelFormat;

constexpr std::uint32_t kWidth = 16, kHeight = 8;
constexpr std::size_t kLongest = 1 << 20;

wire::Hello sound_hello() {
  wire::Hello hello{};
  hello.stamp = wire::own_stamp();
  hello.host = {"n0"};
  hello.memory = 1 << 20;
  hello.simd = {"avx2"};
  return hello;
}

Message sound_strip(std::uint32_t by_message, PixelFormat format) {
  wire::Strip header{};
  header.last = 1;
  header.last_line = kHeight;
  header.by_message = by_message;
  farm::StripStore store;
  const std::size_t words = wire::pixel_words(format);
  const farm::StripBytes strip =
      farm::strip_bytes(header, {{{0, 1, 2}, {1, 0, 16}}, std::vector<std::uint32_t>(18 * words, 5)},
                        {{{3, 0, 3}}, std::vector<std::uint32_t>(3 * words, 6)}, store, format);
  return {strip.data.get(), strip.data.get() + strip.size};
}

Message sound_events() {
  std::array<messages::Event, 3> events{};
  events[0].kind = messages::Event::Kind::span;
  events[1].kind = messages::Event::Kind::sent;
  events[2].kind = messages::Event::Kind::lost;
  return message_of(events);
}

// The host of one node, which has one slot.
struct Host {
  explicit Host(PixelFormat format) : inbox(kWidth, kHeight, format, slots, nullptr), format(format) {}

  void paste(const farm::StripMessage& strip) {
    compositor::Compositor compositor(kWidth, kHeight, 8, format);
    compositor::Frame frame(kWidth, kHeight, 8, 0, format);
    compositor.begin_frame(frame);
    compositor.paste_constant(strip.constant_runs(), strip.constant_pixels(), &frame);
    compositor.paste_moving(frame, strip.moving_runs(), strip.moving_pixels());
  }

  void take_strip() {
    slots.give({0, 0});
    cprobe(wire::kStrip);
    farm::StripStore store;
    paste(*inbox.receive_strip(store));
  }

  void take_events() {
    cprobe(wire::kTrace);
    trace::Trace trace(100);
    trace.begin(inbox.hellos(), 0);
    trace.add(0, inbox.receive_events());
  }

  farm::NodeSlots slots{1, 1};
  farm::NodeInbox inbox;
  PixelFormat format;
};

// Which has a name that ends, and a step of a frame.
void take_beat(Host&) {
  cprobe(wire::kBeat);
  std::vector<std::byte> message(static_cast<std::size_t>(infocount()));
  crecv(wire::kBeat, message.data(), static_cast<long>(message.size()));
  const auto beat = farm::read_beat(message);
  if (!beat) return;
  const bool named = std::ranges::find(beat->host, '\0') != beat->host.end();
  check(named && beat->phase <= wire::Phase::storage, "a beat makes sense");
}

wire::Strip sound_drawn() {
  wire::Strip drawn{};
  drawn.last = 1;
  drawn.last_line = kHeight;
  return drawn;
}

void take_drawn(Host& host) {
  cprobe(wire::kDrawn);
  const wire::Strip drawn = host.inbox.receive_drawn();
  check(drawn.node == 0 && drawn.last_line <= kHeight, "who has drawn is known");
}

// Its hash is a text that ends.
void take_written(Host& host) {
  cprobe(wire::kWritten);
  const wire::Written written = host.inbox.receive_written();
  check(std::ranges::find(written.pixel_hash, '\0') != written.pixel_hash.end(), "word of a file makes sense");
}

void take_storage(Host& host) {
  cprobe(wire::kStorage);
  host.inbox.receive_storage_warning();
}

struct Kind {
  int type;
  Message sound;
  void (*take)(Host& host);
};

std::vector<Kind> kinds(PixelFormat format) {
  return {
      {wire::kHello, message_of(sound_hello()), [](Host& host) { host.inbox.receive_hellos(); }},
      {wire::kLoaded, message_of(wire::Loaded{}), [](Host& host) { host.inbox.wait_until_loaded(); }},
      {wire::kStrip, sound_strip(1, format), [](Host& host) { host.take_strip(); }},
      {wire::kTrace, sound_events(), [](Host& host) { host.take_events(); }},
      {wire::kClock, message_of(1.5), [](Host& host) { host.inbox.receive_time(0); }},
      {wire::kFault, message_of(wire::Fault{0, 3, {"it failed"}}), [](Host& host) { host.inbox.wait(wire::kClock); }},
      {wire::kBeat, message_of(wire::Beat{{"n0"}}), take_beat},
      {wire::kDrawn, message_of(sound_drawn()), take_drawn},
      {wire::kWritten, message_of(wire::Written{3, 0, {"b1"}, 100, 0.5}), take_written},
      {wire::kStorage, {std::byte{'a'}, std::byte{'b'}}, take_storage}};
}

// Strips that lie in a slot: the host sees it, and what is behind the header may be anything at any time.
void take_in_slot(Script& script, PixelFormat format, DeadPeers& peers) {
  static const std::shared_ptr<std::byte> slot(new std::byte[wire::kSlotBytes](), std::default_delete<std::byte[]>());
  Message strip = sound_strip(0, format);
  while (!script.at_end()) edit(strip, script, wire::kSlotBytes);
  std::copy(strip.begin(), strip.end(), slot.get());
  strip.resize(std::min(strip.size(), sizeof(wire::Strip)));
  peers.offer_of(0, slot, wire::kSlotBytes);
  peers.hand({0, wire::kStrip, strip, 0});
  messages::Process process(peers);
  Host host(format);
  host.slots.attach(0, {});
  host.take_strip();
}

}  // namespace

void take(std::string_view input) {
  static const std::array<std::vector<Kind>, 3> all{kinds(PixelFormat::rgb8), kinds(PixelFormat::rgb16),
                                                    kinds(PixelFormat::half)};
  Script script(input);
  const std::size_t format = script.below(all.size());
  const std::size_t which = script.below(all[format].size() + 1);
  DeadPeers peers(1, 1);
  try {
    if (which == all[format].size()) return take_in_slot(script, static_cast<PixelFormat>(format), peers);
    const Kind& kind = all[format][which];
    Message message = kind.sound;
    while (!script.at_end()) edit(message, script, kLongest);
    peers.hand({0, kind.type, std::move(message), 0});
    messages::Process process(peers);
    Host host(static_cast<PixelFormat>(format));
    kind.take(host);
  } catch (const NothingComes&) {
  }
}

const Target target("node_inbox", Form::bytes, take);

}  // namespace mars::fuzz::node_inbox
