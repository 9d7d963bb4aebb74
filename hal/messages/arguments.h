// Checks of the arguments of NX calls, by the rules of hal/nx/nx_messages.h. Each check throws the caller's
// CallFailure.
#pragma once

#include <cstddef>
#include <string>

#include "hal/messages/caller.h"
#include "hal/messages/selection.h"

namespace mars::messages {

// Ranks [first, last), without the sender if it is one of several.
struct Receivers {
  int first;
  int last;
  bool several;
};

struct Outgoing {
  Receivers receivers;
  int type;
  const void* data;
  std::size_t length;

  // For handlers: the one receiver, or -1.
  Envelope envelope() const { return {receivers.several ? -1 : receivers.first, type, length}; }
};

// Where a receive's message goes.
struct ReceiveBuffer {
  void* data;
  std::size_t capacity;
};

Outgoing check_send(const Caller& caller, const char* call, long type, const void* buffer, long length, long node,
                    long pid);
Selection check_selection(const Caller& caller, const char* call, long typesel, long node, long pid);
ReceiveBuffer check_receive_buffer(const Caller& caller, const char* call, void* buffer, long length);

// "1 byte", "7 bytes".
std::string bytes_text(std::size_t bytes);

}  // namespace mars::messages
