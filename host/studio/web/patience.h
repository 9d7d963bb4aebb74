// How long the server waits for others.
#pragma once

#include <chrono>

namespace mars::web {

struct Patience {
  std::chrono::milliseconds request{10'000};  // a request or a handshake to come whole, an answer to be taken
  std::chrono::milliseconds silence{20'000};  // a page without a sign of life, which it is asked for after half of that
  std::chrono::milliseconds answer{5'000};    // the same where another page needs its room
};

}  // namespace mars::web
