#include "node/group/outbox.h"

#include <cstdint>
#include <span>

#include "hal/messages/recorder.h"
#include "hal/nx/nx_messages.h"
#include "node/wire/commands.h"

namespace mars::group {

Outbox::Outbox(std::size_t width, int credits) : credits_(credits) {
  for (int i = 0; i < credits; ++i) slots_.push_back(Slot{raster::StripBuffer(width)});
}

raster::StripBuffer& Outbox::begin(bool constant) {
  current_ = (current_ + 1) % slots_.size();
  Slot& slot = slots_[current_];
  wait(slot);
  slot.buffer.clear(constant);
  return slot.buffer;
}

void Outbox::send(wire::Strip& header) {
  wait_for_credit(header);
  if (stopped_) return;
  Slot& slot = slots_[current_];
  const auto message = slot.buffer.finish(header);
  slot.message = isend(wire::kStrip, message.data(), static_cast<long>(message.size()), myhost(), 0);
  --credits_;
}

void Outbox::wait_for_credit(wire::Strip& header) {
  const double start = dclock();
  constexpr long kCommands = wire::any_of(wire::kCredit, wire::kStop);
  while (!stopped_ && iprobe(kCommands)) take_command();
  if (credits_ == 0) ++header.work.credits_waited;
  while (!stopped_ && credits_ == 0) {
    cprobe(kCommands);
    take_command();
  }
  const double end = dclock();
  header.times.credit += end - start;
  messages::record_span(static_cast<int>(wire::Phase::credit), start, end);
}

// Stop is not received here: the firmware does that.
void Outbox::take_command() {
  if (infotype() == wire::kStop)
    stopped_ = true;
  else
    receive_credit();
}

void Outbox::receive_credit() {
  wire::Credit credit;
  crecv(wire::kCredit, &credit, sizeof credit);
  const auto message = std::as_bytes(std::span(&credit, 1)).first(static_cast<std::size_t>(infocount()));
  credits_ += wire::read_credit(message, static_cast<std::int32_t>(slots_.size()) - credits_);
}

void Outbox::flush() {
  for (Slot& slot : slots_) wait(slot);
}

void Outbox::wait(Slot& slot) {
  if (slot.message >= 0) msgwait(slot.message);
  slot.message = -1;
}

}  // namespace mars::group
