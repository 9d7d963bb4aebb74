#include "hal/messages/ledger.h"

namespace mars::messages {

std::uint32_t Ledger::sent(const Envelope& to, double begin) {
  Traffic::Count& count = to.from == host_ ? traffic_.to_host : traffic_.to_nodes;
  ++count.messages;
  count.bytes += to.length;
  const std::uint32_t number = numbers_[static_cast<std::size_t>(to.from)].sent++;
  if (recorder_ != nullptr) recorder_->message(Event::Kind::sent, begin, to, number);
  return number;
}

void Ledger::record_taken(const Envelope& envelope, double begin, std::uint32_t number) {
  if (recorder_ != nullptr) recorder_->message(Event::Kind::taken, begin, envelope, number);
}

void Ledger::waited(const Envelope& came, double begin) {
  if (recorder_ != nullptr) recorder_->message(Event::Kind::waited, begin, came, 0);
}

double Ledger::begin() const { return recorder_ == nullptr ? 0 : recorder_->now(); }

}  // namespace mars::messages
