// The messages that a receive or probe asks for.
#pragma once

#include <cstdint>

#include "hal/messages/backend.h"
#include "hal/messages/message_types.h"

namespace mars::messages {

struct Selection {
  std::int32_t typesel = -1;
  int from = -1;  // -1: any rank

  bool selects(const Envelope& envelope) const {
    return messages::selects(typesel, envelope.type) && (from == -1 || from == envelope.from);
  }
};

}  // namespace mars::messages
