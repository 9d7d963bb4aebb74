#include "tests/render/live_host.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <utility>

#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "host/render/farm/assembly.h"
#include "node/wire/greeting.h"
#include "node/wire/scene.h"

namespace mars::test {
namespace {

constexpr std::int32_t kSlots = 2;

template <typename T>
void append(std::vector<std::byte>& message, std::span<const T> items) {
  const auto bytes = std::as_bytes(items);
  message.insert(message.end(), bytes.begin(), bytes.end());
}

template <typename T>
std::vector<std::byte> message_of(const T& head) {
  std::vector<std::byte> message;
  append(message, std::span(&head, 1));
  return message;
}

std::vector<std::byte> receive(long type) {
  cprobe(wire::any_of(type, long{wire::kFault}));
  std::vector<std::byte> message(static_cast<std::size_t>(infocount()));
  if (infotype() == wire::kFault) {
    crecv(wire::kFault, message.data(), static_cast<long>(message.size()));
    throw std::runtime_error(reinterpret_cast<const wire::Fault*>(message.data())->reason.data());
  }
  crecv(type, message.data(), static_cast<long>(message.size()));
  return message;
}

// A strip's pixels into pictures of `width`; nullptr: left out.
void put_runs(std::span<const std::byte> message, std::uint32_t width, Pixels* constant, Pixels* moving) {
  const auto& strip = *reinterpret_cast<const wire::Strip*>(message.data());
  const auto* pixels = reinterpret_cast<const std::uint32_t*>(message.data() + sizeof strip);
  const std::span runs(reinterpret_cast<const wire::Run*>(pixels + strip.pixels),
                       strip.constant_runs + strip.moving_runs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Pixels* const to = i < strip.constant_runs ? constant : moving;
    if (to != nullptr)
      std::copy_n(pixels, runs[i].count, to->data() + std::size_t{runs[i].line} * width + runs[i].first);
    pixels += runs[i].count;
  }
}

}  // namespace

bool LivePicture::cut() const {
  return std::ranges::any_of(lasts, [](const wire::Strip& strip) { return strip.cut == 1; });
}

LiveHost::LiveHost() : nodes_(static_cast<int>(numnodes())), hellos_(static_cast<std::size_t>(nodes_)) {
  for (int i = 0; i < nodes_; ++i) {
    const auto message = receive(wire::kHello);
    const auto& hello = *reinterpret_cast<const wire::Hello*>(message.data());
    hellos_.at(static_cast<std::size_t>(hello.node)) = hello;
  }
}

LiveHost::~LiveHost() {
  if (std::uncaught_exceptions() > 0) return;
  for (int node = 0; node < nodes_; ++node) send(wire::kStop, node, {});
}

void LiveHost::send(long type, int node, std::span<const std::byte> message) {
  csend(type, message.data(), static_cast<long>(message.size()), node, 0);
}

void LiveHost::give_credit(int node, std::uint32_t slot) {
  send(wire::kCredit, node, message_of(wire::Credit{slot, 1}));
}

void LiveHost::load(const wire::FilmData& film) {
  const auto block = wire::pack(film);
  wire::Load load{};
  load.stamp = wire::own_stamp();
  load.film_bytes = block.size();
  load.memory = std::uint64_t{64} << 20;
  load.credits = kSlots;
  load.mapping = wire::Mapping::cost;
  load.groups = 1;
  load.live = 1;
  auto message = message_of(load);
  for (const wire::Hello& hello : hellos_) append(message, std::span(&hello.machine, 1));
  for (int node = 0; node < nodes_; ++node) send(wire::kLoad, node, message);
  for (std::size_t at = 0; at < block.size(); at += wire::kFilmPiece)
    send(wire::kFilmBlock, 0, std::span(block).subspan(at, std::min<std::size_t>(block.size() - at, wire::kFilmPiece)));
  for (int i = 0; i < nodes_; ++i) receive(wire::kLoaded);
  while (iprobe(wire::kStrip) != 0) receive(wire::kStrip);
  views_.clear();
  asked_.clear();
  for (int node = 0; node < nodes_; ++node)
    for (std::uint32_t slot = 0; slot < kSlots; ++slot) give_credit(node, slot);
}

std::uint32_t LiveHost::begin(std::uint32_t view, const wire::FilmData& scene, std::uint64_t still_memory) {
  const auto block = wire::pack_scene(scene);
  const std::uint32_t picture = ++last_picture_;
  auto message = message_of(wire::BeginView{view, picture, block.size(), still_memory, 0});
  append(message, std::span<const std::byte>(block));
  for (int node = 0; node < nodes_; ++node) send(wire::kBeginView, node, message);
  const wire::FilmSettings& settings = scene.settings;
  const FilmBlock nothing([&] {
    wire::FilmData empty = scene;
    empty.shapes.clear(), empty.patches.clear(), empty.segments.clear(), empty.moving.clear(), empty.names.clear();
    empty.intervals = {{0, 1, 0, 0}};
    return empty;
  }());
  const auto plain = static_cast<std::uint32_t>(
      farm::background_pixel(nothing.view(), nothing.view().intervals()[0], wire::PixelFormat::rgb8));
  views_[view] = {settings.width, settings.height, plain, {}};
  asked_[picture] = {{view, {}, {}}, true, static_cast<std::size_t>(nodes_), {}};
  return picture;
}

std::uint32_t LiveHost::draw(std::uint32_t view, const Change& change, int node) {
  const std::uint32_t picture = ++last_picture_;
  auto message = message_of(wire::Draw{view, picture, static_cast<std::uint32_t>(change.segments.size()),
                                       static_cast<std::uint32_t>(change.patches.size())});
  append(message, std::span(change.segments));
  append(message, std::span(change.patches));
  send(wire::kDraw, node, message);
  asked_[picture] = {{view, {}, {}}, false, 1, {}};
  return picture;
}

void LiveHost::close(std::uint32_t view) {
  for (int node = 0; node < nodes_; ++node) send(wire::kCloseView, node, message_of(wire::CloseView{view}));
}

LivePicture LiveHost::finish(std::uint32_t picture) {
  Asked& asked = asked_.at(picture);
  while (asked.nodes_left > 0) take_strip();
  if (!asked.picture.cut()) paste(asked);
  LivePicture done = std::move(asked.picture);
  asked_.erase(picture);
  return done;
}

void LiveHost::take_strip() {
  auto message = receive(wire::kStrip);
  const auto& strip = *reinterpret_cast<const wire::Strip*>(message.data());
  Asked& asked = asked_.at(strip.frame);
  EXPECT_EQ(strip.interval, asked.picture.view);
  EXPECT_EQ(strip.kind, asked.is_keyframe ? wire::FrameKind::keyframe : wire::FrameKind::inbetween);
  EXPECT_LE(strip.cut, strip.last);
  give_credit(strip.node, strip.slot);
  if (strip.last == 1) {
    asked.picture.lasts.push_back(strip);
    --asked.nodes_left;
  }
  asked.strips.push_back(std::move(message));
}

// Constant parts are the background of the interval, moving ones lie over it.
void LiveHost::paste(Asked& asked) {
  View& view = views_.at(asked.picture.view);
  if (asked.is_keyframe) view.background.assign(std::size_t{view.width} * view.height, view.plain);
  for (const auto& message : asked.strips) put_runs(message, view.width, &view.background, nullptr);
  asked.picture.pixels = view.background;
  for (const auto& message : asked.strips) put_runs(message, view.width, nullptr, &asked.picture.pixels);
}

}  // namespace mars::test
