#include "node/group/outbox.h"

#include <bit>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "node/wire/commands.h"

namespace mars::group {

Outbox::Outbox(wire::PixelFormat format, int slots, const collectives::Group& group, bool watched)
    : slot_bytes_(wire::slot_bytes(format)),
      memory_(static_cast<std::size_t>(slots) * slot_bytes_),
      strip_(format, watched),
      slots_(static_cast<std::size_t>(slots)),
      group_(group) {
  memory_.prefer_large_pages();
}

// Of the slots it takes always the same first: what lies there is the likeliest to be in a cache still.
raster::StripBuffer& Outbox::begin(std::size_t width, bool constant, wire::WorkCounts& work) {
  take_commands(work);
  if (owned_ != 0) current_ = static_cast<std::size_t>(std::countr_zero(owned_));
  wait(slots_[current_]);
  strip_.begin(memory_of(current_), width, constant);
  return strip_;
}

void Outbox::send(wire::Strip& header, std::span<const std::uint32_t> edge_boxes) {
  if (stopped_) return;
  Slot& slot = slots_[current_];
  header.slot = static_cast<std::uint32_t>(current_);
  header.by_message = slot.by_message;
  const auto strip = strip_.finish(header, edge_boxes);
  const std::size_t bytes = slot.by_message == 1 ? strip.size() : sizeof header;
  slot.message = isend(wire::kStrip, strip.data(), static_cast<long>(bytes), myhost(), 0);
  owned_ &= ~(std::uint32_t{1} << current_);
}

void Outbox::take_commands(wire::WorkCounts& work) {
  constexpr long kCommands = wire::any_of(wire::kCredit, wire::kStop, wire::kLoad);
  while (!stopped_ && iprobe(kCommands)) take_command();
  if (stopped_ || owned_ != 0) return;
  ++work.credits_waited;
  messages::keep_to_nobody();
  while (!stopped_ && owned_ == 0) {
    cprobe(kCommands);
    take_command();
  }
  messages::keep_to(group_.first, group_.count);
}

raster::StripBuffer& Outbox::begin_own(std::size_t width, bool constant) {
  look_for_stop();
  strip_.begin(memory_of(0), width, constant);
  return strip_;
}

std::span<const std::byte> Outbox::finish_own(wire::Strip& header) { return strip_.finish(header); }

void Outbox::send_drawn(wire::Strip header) {
  header.constant_runs = header.moving_runs = 0;
  header.work.bytes_to_host = 0;
  if (!stopped_) csend(wire::kDrawn, &header, sizeof header, myhost(), 0);
}

void Outbox::look_for_stop() { stopped_ = stopped_ || iprobe(wire::any_of(wire::kStop, wire::kLoad)) != 0; }

// Stop and Load are not received here: the firmware does that.
void Outbox::take_command() {
  if (infotype() == wire::kCredit)
    receive_credit();
  else
    stopped_ = true;
}

void Outbox::receive_credit() {
  wire::Credit received;
  crecv(wire::kCredit, &received, sizeof received);
  const auto message = std::as_bytes(std::span(&received, 1)).first(static_cast<std::size_t>(infocount()));
  const wire::Credit& credit = wire::read_credit(message, owned_, slots_.size());
  slots_[credit.slot].by_message = credit.by_message;
  owned_ |= std::uint32_t{1} << credit.slot;
}

std::span<std::byte> Outbox::memory_of(std::size_t slot) const {
  return memory_.bytes().subspan(slot * slot_bytes_, slot_bytes_);
}

void Outbox::discard_sent() {
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    if (slots_[slot].by_message == 0 || slots_[slot].message < 0 || !msgdone(slots_[slot].message)) continue;
    slots_[slot].message = -1;
    messages::discard(memory_of(slot));
  }
}

void Outbox::flush() {
  for (Slot& slot : slots_) wait(slot);
}

void Outbox::wait(Slot& slot) {
  if (slot.message >= 0) msgwait(slot.message);
  slot.message = -1;
}

}  // namespace mars::group
