#include "tests/hal/storm/ledger.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "hal/messages/message_types.h"

namespace mars::storm {
namespace {

std::string text_of(int from, std::int32_t type, std::uint32_t number, std::size_t length) {
  return "message " + std::to_string(number) + " from " + std::to_string(from) + ", type " + std::to_string(type) +
         ", " + std::to_string(length) + " bytes";
}

}  // namespace

void Ledger::open(int round, int nodes) {
  due_.clear();
  taken_.clear();
  flushes_.clear();
  owed_ = 0;
  for (int from = 0; from <= nodes; ++from)
    for (const Send& send : sends_of(seed_, round, from, nodes)) {
      const bool to_all = send.to == -1 && me_ != nodes && me_ != from;
      if (send.to == me_ || to_all) add(from, send);
    }
}

void Ledger::add(int from, const Send& send) {
  due_[{from, send.type}].push_back({send.number, send.length});
  if (!kind_of(send.type).loose()) ++owed_;
}

void Ledger::received(const Taker& taker, const Came& came, const unsigned char* bytes) {
  const bool loose = kind_of(came.type).loose();
  std::deque<Due>& due = due_[{came.from, came.type}];
  if (loose && came.length >= 8) {
    for (; !due.empty() && due.front().number != number_in(bytes); due.pop_front())
      lost(came.from, came.type, due.front());
  }
  if (due.empty()) throw std::runtime_error("not due: " + text_of(came.from, came.type, 0, came.length));
  const Due first = due.front();
  const std::string text = text_of(came.from, came.type, first.number, first.length);
  if (first.length != came.length)
    throw std::runtime_error(std::to_string(came.length) + " bytes came where the next is " + text);
  const auto wanted = contents(seed_, came.from, first.number, first.length);
  if (!std::equal(wanted.begin(), wanted.end(), bytes)) throw std::runtime_error("other bytes came: " + text);
  due.pop_front();
  if (!loose) --owed_;
  taken_[came.from].push_back({first.number, came.type, taker});
}

// Throws unless it may have been lost.
void Ledger::lost(int from, std::int32_t type, const Due& due) const {
  if (kind_of(type).force()) return;
  const auto explains = [&](const Flush& flush) {
    return messages::selects(flush.typesel, type) && (flush.node == -1 || flush.node == from);
  };
  if (kind_of(type).flushed && std::any_of(flushes_.begin(), flushes_.end(), explains)) return;
  throw std::runtime_error("lost: " + text_of(from, type, due.number, due.length));
}

void Ledger::check_order(int from, const std::vector<Taken>& taken) const {
  for (const Taken& early : taken)
    for (const Taken& late : taken) {
      if (early.number >= late.number || !messages::selects(late.taker.typesel, early.type)) continue;
      if (early.taker.order < late.taker.order) continue;
      throw std::runtime_error("a receive posted before another got " + text_of(from, late.type, late.number, 0) +
                               " and not the earlier " + text_of(from, early.type, early.number, 0));
    }
}

void Ledger::close() {
  for (const auto& [key, due] : due_)
    for (const Due& one : due) lost(key.first, key.second, one);
  for (const auto& [from, taken] : taken_) check_order(from, taken);
}

}  // namespace mars::storm
