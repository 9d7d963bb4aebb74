// The function that hsend, hrecv and hsendrecv call when their request is done.
#pragma once

#include "hal/messages/backend.h"

namespace mars::messages {

// Either of two forms, or none.
struct Handler {
  void (*plain)(long type, long length, long node, long pid) = nullptr;
  void (*extended)(long type, long length, long node, long pid, long parameter) = nullptr;
  long parameter = 0;  // of the extended form

  explicit operator bool() const { return plain != nullptr || extended != nullptr; }
  void operator()(const Envelope& envelope) const {
    const auto length = static_cast<long>(envelope.length);
    if (plain != nullptr) plain(envelope.type, length, envelope.from, 0);
    if (extended != nullptr) extended(envelope.type, length, envelope.from, 0, parameter);
  }
};

}  // namespace mars::messages
