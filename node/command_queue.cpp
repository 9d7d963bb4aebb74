#include "node/command_queue.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "hal/nx/nx_messages.h"
#include "node/wire/protocol.h"

namespace mars::node {
namespace {

constexpr long kCommands = wire::any_of(wire::kLoad, wire::kRender, wire::kCredit, wire::kStop, wire::kClock,
                                        wire::kBeginView, wire::kDraw, wire::kCloseView, wire::kWrite);

// Receives the message that was probed.
void receive_probed(long type, std::vector<std::byte>& into) {
  into.resize(static_cast<std::size_t>(infocount()));
  crecv(type, into.data(), static_cast<long>(into.size()));
}

// BeginView and CloseView begin with their view.
bool is_of(std::span<const std::byte> message, std::uint32_t view) {
  std::uint32_t number = 0;
  if (message.size() < sizeof number) return false;
  std::memcpy(&number, message.data(), sizeof number);
  return number == view;
}

}  // namespace

long CommandQueue::wait() {
  if (!ahead_.empty()) return type_ = ahead_.front().type;
  cprobe(kCommands);
  return type_ = infotype();
}

bool CommandQueue::has_come() const { return !ahead_.empty() || iprobe(kCommands) != 0; }

std::span<const std::byte> CommandQueue::receive() {
  if (ahead_.empty()) {
    receive_probed(type_, command_);
  } else {
    command_ = std::move(ahead_.front().message);
    ahead_.pop_front();
  }
  if (type_ == wire::kLoad) load_comes_ = false;
  return command_;
}

bool CommandQueue::ends(std::uint32_t view) {
  receive_ahead();
  return load_comes_ || std::ranges::any_of(ahead_, [&](const Ahead& command) {
           return command.type != wire::kDraw && is_of(command.message, view);
         });
}

// A Load stays where it is, with all that comes behind it.
void CommandQueue::receive_ahead() {
  while (!load_comes_ && iprobe(wire::any_of(wire::kLoad, wire::kBeginView, wire::kDraw, wire::kCloseView)) != 0) {
    const long type = infotype();
    load_comes_ = type == wire::kLoad;
    if (load_comes_) return;
    ahead_.push_back({type, {}});
    receive_probed(type, ahead_.back().message);
  }
}

}  // namespace mars::node
