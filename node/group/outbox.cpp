#include "node/group/outbox.h"

#include "hal/nx/nx_messages.h"
#include "hal/messages/recorder.h"

namespace mars::node {

Outbox::Outbox(std::size_t width, int credits) : credits_(credits) {
  for (int i = 0; i < credits; ++i) slots_.push_back(Slot{StripBuffer(width)});
}

StripBuffer& Outbox::begin(bool constant) {
  current_ = (current_ + 1) % slots_.size();
  Slot& slot = slots_[current_];
  wait(slot);
  slot.buffer.clear(constant);
  return slot.buffer;
}

void Outbox::send(Strip& header) {
  wait_for_credit(header);
  Slot& slot = slots_[current_];
  const auto message = slot.buffer.finish(header);
  slot.message = isend(kStrip, message.data(), static_cast<long>(message.size()), myhost(), 0);
  --credits_;
}

void Outbox::wait_for_credit(Strip& header) {
  const double start = dclock();
  while (iprobe(kCredit)) receive_credit();  // which may give the processor away
  if (credits_ == 0) ++header.work.credits_waited;
  while (credits_ == 0) receive_credit();
  const double end = dclock();
  header.times.credit += end - start;
  hal::record_span(static_cast<int>(Phase::credit), start, end);
}

void Outbox::receive_credit() {
  Credit credit;
  crecv(kCredit, &credit, sizeof credit);
  credits_ += credit.count;
}

void Outbox::flush() {
  for (Slot& slot : slots_) wait(slot);
}

void Outbox::wait(Slot& slot) {
  if (slot.message >= 0) msgwait(slot.message);
  slot.message = -1;
}

}  // namespace mars::node
