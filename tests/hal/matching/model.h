// Which message goes into which receive, as plainly as it can be said: lists in order, searched from the front.
#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <optional>
#include <vector>

namespace mars::messages::model {

// By the words of NX: typesel cut to 32 bits; 0 or more: that type; else bit k of it for type k, bit 30 from 30 on,
// of ordinary types.
inline bool selects(long typesel, int type) {
  const long low = typesel & 0xffffffff;
  if (low < 0x80000000) return type == low;
  if (type > 999'999'999) return false;
  for (int k = 0; k < 30; ++k)
    if (type == k) return (low >> k) % 2 == 1;
  return (low >> 30) % 2 == 1;
}

struct Message {
  int number;  // in order of arrival
  int from;
  int type;
  std::size_t length;

  bool force() const { return type > 999'999'999; }
};

struct Receive {
  enum Kind { by_id, by_handler } kind;
  long name;  // its id, or its handler's number
  long typesel;
  long node;  // -1: any
  std::size_t capacity;
  std::optional<Message> got = {};
  bool too_short = false;

  bool selects(const Message& message) const {
    return model::selects(typesel, message.type) && (node == -1 || node == message.from);
  }
};

class Model {
 public:
  std::list<Receive> receives;  // in order of posting; those with a message or an error are done
  std::list<Message> waiting;   // in order of arrival
  std::vector<long> due;        // numbers of handlers, in the order in which they must run

  const Message* first(long typesel, long node) const {
    for (const Message& message : waiting)
      if (Receive{Receive::by_id, 0, typesel, node, 0}.selects(message)) return &message;
    return nullptr;
  }

  void arrives(const Message& message) {
    for (Receive& receive : receives) {
      if (receive.got || receive.too_short || !receive.selects(message)) continue;
      if (receive.capacity < message.length) {
        receive.too_short = true;
        continue;
      }
      receive.got = message;
      if (receive.kind == Receive::by_handler) due.push_back(receive.name);
      return;
    }
    if (message.force()) return;
    const auto later = [&](const Message& other) { return other.number > message.number; };
    waiting.insert(std::find_if(waiting.begin(), waiting.end(), later), message);
  }

  // Where the first message that waits and is selected is too long, the receive fails and the message stays.
  void post(const Receive& receive) {
    const Message* message = first(receive.typesel, receive.node);
    receives.push_back(receive);
    if (message == nullptr) return;
    receives.back().too_short = message->length > receive.capacity;
    if (receives.back().too_short) return;
    receives.back().got = *message;
    if (receive.kind == Receive::by_handler) due.push_back(receive.name);
    remove(message->number);
  }

  void remove(int number) {
    waiting.remove_if([number](const Message& message) { return message.number == number; });
  }

  void cancel(std::list<Receive>::iterator receive) {
    const std::optional<Message> got = receive->got;
    receives.erase(receive);
    if (got) arrives(*got);
  }
};

}  // namespace mars::messages::model
