#include "node/heartbeat.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "node/wire/commands.h"

namespace mars::node {
namespace {

// Seconds.
constexpr double kLook = 0.5;       // from one look for the host's beats to the next
constexpr double kBeat = 1.0;       // from one of the node's to the next
constexpr double kMostALook = 1.0;  // that count as observed: a job that was suspended goes on
constexpr double kPatience = 30.0;

}  // namespace

HostLost::HostLost() : Failure("nothing was heard of the host for 30 s", "", "start the rendering again") {}

Heartbeat::Heartbeat(const NodeIdentity& identity)
    : is_traced_(identity.is_traced), has_machine_clock_(messages::process().backend().has_machine_clock()) {
  std::copy_n(identity.host.begin(), std::min(identity.host.size(), own_.host.size() - 1), own_.host.begin());
  own_.process = identity.process;
  messages::process().while_waiting([this] { look(true); });
}

Heartbeat::~Heartbeat() { messages::process().while_waiting({}); }

void Heartbeat::look(bool waits) {
  if (!has_machine_clock_) return;
  if (at_each_look_) at_each_look_();
  const double now = dclock();
  if (now < looked_ + kLook) return;
  const double passed = std::min(now - std::exchange(looked_, now), kMostALook);
  if (hear())
    unheard_ = 0;
  else if (begun_)
    unheard_ += passed;
  if (unheard_ >= kPatience && !host_is_debugged()) throw HostLost();
  if (!begun_ || now < spoken_ + kBeat) return;
  spoken_ = now;
  speak(waits);
}

// Whether a beat came.
bool Heartbeat::hear() {
  bool came = false;
  for (; iprobe(wire::kBeat) != 0; came = true) {
    std::array<std::byte, sizeof(wire::Beat)> message;
    wire::check_size("Beat", static_cast<std::size_t>(infocount()), message.size());
    crecv(wire::kBeat, message.data(), sizeof message);
    host_ = wire::read_beat(message);
    begun_ = true;
  }
  return came;
}

void Heartbeat::speak(bool waits) {
  own_.waits = waits ? 1 : 0;
  own_.traced = is_traced_ && is_traced_(own_.process) ? 1 : 0;
  send();
}

void Heartbeat::send() const { csend(wire::kBeat, &own_, sizeof own_, myhost(), 0); }

void Heartbeat::begin_frame(std::uint32_t frame) {
  own_.frame = static_cast<std::int32_t>(frame);
  own_.waits = 0;
  if (begun_) send();
}

// One that is stopped by its debugger cannot say so; where it is on this machine, it shows.
bool Heartbeat::host_is_debugged() const {
  return host_.traced == 1 || (host_.host == own_.host && is_traced_ && is_traced_(host_.process));
}

}  // namespace mars::node
