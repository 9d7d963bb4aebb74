// Nodes that follow a test's script in place of the firmware: threads that say by NX calls what a node would, or what
// none should. And renderings by such nodes.
#pragma once

#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "hal/messages/offered_memory.h"
#include "hal/nx/nx_messages.h"
#include "hal/threads/run_threads.h"
#include "host/render/farm/farm.h"
#include "tests/host/render/farm/empty_film.h"
#include "tests/host/render/farm/strips.h"
#include "node/wire/commands.h"
#include "node/wire/greeting.h"

namespace mars::farm {

class ScriptedNode {
 public:
  // Whether the host sees the node's slots; else its strips go by message.
  explicit ScriptedNode(bool seen = true) : seen_(seen) {}

  // A sound one; every node is a machine of its own, n0, n1, ...
  static wire::Hello hello() {
    wire::Hello hello{};
    hello.stamp = wire::own_stamp();
    hello.node = hello.machine = static_cast<std::int32_t>(mynode());
    hello.memory = 1 << 20;
    const std::string name = "n" + std::to_string(mynode());
    std::memcpy(hello.host.data(), name.data(), name.size());
    return hello;
  }

  template <typename Message>
  static void send(long type, const Message& message) {
    csend(type, &message, sizeof message, myhost(), 0);
  }

  // Greets and takes the film, unless the host says stop.
  void boot() {
    send(wire::kHello, hello());
    if (take_load()) send(wire::kLoaded, loaded());
  }

  // Makes the slots.
  wire::Loaded loaded() {
    if (!seen_) return {};
    slots_.emplace(static_cast<std::size_t>(load.credits) * wire::kSlotBytes);
    return {slots_->name(), {}};
  }

  // Its clock is asked first where the run is traced.
  bool take_load() {
    while (true) {
      cprobe(wire::any_of(wire::kLoad, wire::kClock, wire::kStop));
      if (infotype() == wire::kStop) return false;
      if (infotype() == wire::kLoad) break;
      receive(wire::kClock);
      send(wire::kClock, dclock());
    }
    const std::vector<std::byte> message = receive(wire::kLoad);
    std::memcpy(&load, message.data(), sizeof load);
    for (std::uint64_t at = 0; at < load.film_bytes; at += film_pieces.back().size()) {
      film_pieces.push_back(receive(wire::kFilmBlock));
      pass_on(film_pieces.back());
    }
    return true;
  }

  // A piece of the film: each node leads its machine.
  static void pass_on(const std::vector<std::byte>& piece) {
    for (long to = 2 * mynode() + 1; to <= 2 * mynode() + 2 && to < numnodes(); ++to)
      csend(wire::kFilmBlock, piece.data(), static_cast<long>(piece.size()), to, 0);
  }

  static std::vector<std::byte> receive(long type) {
    cprobe(type);
    std::vector<std::byte> message(static_cast<std::size_t>(infocount()));
    crecv(type, message.data(), static_cast<long>(message.size()));
    return message;
  }

  // The next command; none: stop.
  struct Command {
    wire::Render render;
    std::vector<std::uint32_t> frames;
    std::vector<std::int32_t> cycle{};
  };
  std::optional<Command> next_command() {
    while (true) {
      cprobe(wire::any_of(wire::kRender, wire::kCredit, wire::kStop));
      if (infotype() == wire::kStop) {
        receive(wire::kStop);
        return std::nullopt;
      }
      if (infotype() == wire::kRender) break;
      take_credit();
    }
    const std::vector<std::byte> message = receive(wire::kRender);
    Command command;
    std::memcpy(&command.render, message.data(), sizeof command.render);
    command.frames.resize(command.render.frame_count);
    std::iota(command.frames.begin(), command.frames.end(), command.render.first_frame);
    const std::size_t list_bytes = command.render.listed == 1 ? command.frames.size() * sizeof(std::uint32_t) : 0;
    if (list_bytes > 0) std::memcpy(command.frames.data(), message.data() + sizeof command.render, list_bytes);
    command.cycle.resize(command.render.cycle);
    if (!command.cycle.empty())
      std::memcpy(command.cycle.data(), message.data() + sizeof command.render + list_bytes,
                  command.cycle.size() * sizeof(std::int32_t));
    return command;
  }

  void take_credit() {
    const std::vector<std::byte> message = receive(wire::kCredit);
    std::memcpy(&credits.emplace_back(), message.data(), sizeof(wire::Credit));
    EXPECT_EQ(credits.back().by_message, seen_ ? 0u : 1u);
  }

  // The next slot that was given; waits for one.
  wire::Credit next_credit() {
    while (credits.empty()) take_credit();
    const wire::Credit credit = credits.front();
    credits.pop_front();
    return credit;
  }

  std::span<std::byte> slot(std::uint32_t number) {
    return slots_->bytes().subspan(number * wire::kSlotBytes, wire::kSlotBytes);
  }

  // The header of this node's only strip of a frame.
  static wire::Strip strip_of(const Command& command, std::uint32_t frame) {
    wire::Strip strip{};
    strip.frame = frame;
    strip.interval = command.render.interval;
    const bool keyframe = command.render.goes_on == 0 && frame == command.frames.front();
    strip.kind = keyframe ? wire::FrameKind::keyframe : wire::FrameKind::inbetween;
    strip.node = static_cast<std::int32_t>(mynode());
    strip.last = 1;
    strip.last_line = 8;
    return strip;
  }

  // One pixel, in line and column 0.
  void send_strip(wire::Strip header, std::uint32_t pixel) {
    const wire::Credit credit = next_credit();
    header.slot = credit.slot;
    header.by_message = credit.by_message;
    StripStore store;
    std::vector<std::uint32_t> words(wire::pixel_words(load.pixel_format));
    words.front() = pixel;
    const StripBytes bytes = strip_bytes(header, {}, {{{0, 0, 1}}, words}, store, load.pixel_format);
    if (seen_) std::memcpy(slot(credit.slot).data(), bytes.data.get(), bytes.size);
    csend(wire::kStrip, bytes.data.get(), static_cast<long>(seen_ ? sizeof header : bytes.size), myhost(), 0);
  }

  // This node's frames of a task: the keyframe and its inbetweens.
  static std::vector<std::uint32_t> own_frames(const Command& command) {
    const wire::RenderCommand read{command.render, command.frames, command.cycle};
    std::vector<std::uint32_t> own;
    if (command.render.goes_on == 0) own.push_back(command.frames.front());
    for (std::size_t k = 0; k < read.inbetweens().size(); ++k)
      if (const auto team = read.team(k); mynode() >= team.first && mynode() < team.first + team.count)
        own.push_back(read.inbetweens()[k]);
    return own;
  }

  // Draws all that it is given, each frame as a pixel of the frame's number and 1000, until the host says stop.
  void draw_all() {
    while (const auto command = next_command())
      for (const std::uint32_t frame : own_frames(*command)) {
        if (!wait_for_credit()) return;
        send_strip(strip_of(*command, frame), 1000 + frame);
      }
  }

  // False: the host says stop.
  bool wait_for_credit() {
    while (credits.empty()) {
      cprobe(wire::any_of(wire::kCredit, wire::kStop));
      if (infotype() == wire::kStop) return false;
      take_credit();
    }
    return true;
  }

  wire::Load load{};
  std::vector<std::vector<std::byte>> film_pieces;
  std::deque<wire::Credit> credits;  // slots that are the node's

 private:
  bool seen_;
  std::optional<messages::OfferedMemory> slots_;
};

// Keeps the first and the last word of each frame.
class FirstPixels : public sinks::Sink {
 public:
  void take(compositor::Frame& frame) override {
    if (taken) taken(frame.number);
    const std::lock_guard lock(mutex_);
    pixels[frame.number] = frame.pixels.front();
    last[frame.number] = frame.pixels.back();
  }
  std::map<std::uint32_t, std::uint32_t> pixels;
  std::map<std::uint32_t, std::uint32_t> last;
  std::function<void(std::uint32_t frame)> taken;

 private:
  std::mutex mutex_;
};

struct ScriptedRun {
  int nodes = 1;
  PlanRequest work;
  FarmOptions farm;
  std::uint32_t buffers = 3;
  FarmListener listener;
  FirstPixels sink;
  wire::PixelFormat format = wire::PixelFormat::rgb8;
  threads::WrapBackend wrap = {};

  FarmReport render(const EmptyFilm& film, const std::function<void()>& node) {
    const Plan plan = make_plan(film.view(), work, nodes);
    FarmReport report;
    const auto host = [&] {
      sinks::SinkPool pool(sink,
                           {film.view().settings().width, film.view().settings().height, 8, buffers, 1, 0, format});
      report = render_film(film.block(), plan, farm, pool, listener);
    };
    threads::run_threads(nodes, host, node, wrap);
    return report;
  }
};

inline std::vector<std::uint32_t> frames_to(std::uint32_t end) {
  std::vector<std::uint32_t> frames(end);
  for (std::uint32_t frame = 0; frame < end; ++frame) frames[frame] = frame;
  return frames;
}

// As ScriptedNode::draw_all makes them.
inline std::map<std::uint32_t, std::uint32_t> pixels_of(const std::vector<std::uint32_t>& frames) {
  std::map<std::uint32_t, std::uint32_t> pixels;
  for (const std::uint32_t frame : frames) pixels[frame] = 1000 + frame;
  return pixels;
}

}  // namespace mars::farm
