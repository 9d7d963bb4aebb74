// Matches messages with receives: the receives of one process that wait for their message, and the messages that wait
// for their receive. Both are in order, of posting and of arrival; the first that fits is taken.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/messages/message_pool.h"
#include "hal/messages/requests.h"
#include "hal/messages/selection.h"

namespace mars::messages {

class Matching {
 public:
  void post(Request& request) { posted_.push_back(&request); }
  void unpost(const Request& request);
  bool none_posted() const { return posted_.empty(); }
  // The first posted receive that selects the message, or nullptr.
  Request* posted_for(const Envelope& envelope) const;

  // Numbers what arrives, for its place among what waits.
  std::uint64_t next_arrival() { return ++arrivals_; }
  // By the message's `arrival`.
  void queue(Message* message) { waiting_.insert(message); }
  // The first message that waits and is selected, or nullptr.
  Message* find(const Selection& selection) const {
    return waiting_.find([&](const Envelope& envelope) { return selection.selects(envelope); });
  }
  void remove(Message* message) { waiting_.remove(message); }

 private:
  std::vector<Request*> posted_;
  MessageList waiting_;
  std::uint64_t arrivals_ = 0;
};

}  // namespace mars::messages
