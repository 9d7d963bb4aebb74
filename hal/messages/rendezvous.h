// Strict mode: a send of more than 100 bytes is done only when its message has been received, as if nothing
// were buffered. It finds programs that rely on buffers. The receiver says by an internal message that it has
// one. Waits in which nothing arrives for long are reported on standard error. All ranks must be strict.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/messages/caller.h"
#include "hal/messages/message_types.h"
#include "hal/messages/requests.h"

namespace mars::messages {

class Rendezvous {
 public:
  // Silences that last so long are reported.
  void set_strict(std::chrono::milliseconds patience) { patience_ = patience; }
  bool strict() const { return patience_.has_value(); }

  // Whether the receiver has to say that it has such a message.
  bool concerns(int type, std::size_t length) const {
    return strict() && length > kBuffered && type_class(type) == TypeClass::ordinary;
  }

  // `request` is a send; its message number `number` from here to `rank` is to be received.
  void expect(int rank, std::uint32_t number, Request& request);
  void received(int rank, std::uint32_t number);
  void forget(const Request& request);

  // Something has arrived, or a wait begins: the silence is over.
  void end_silence() {
    if (strict()) begin_silence();
  }
  // Reports the silence in which `request` waits, once: if it is long, or as it is.
  void report_silence(const Caller& caller, const Request& request);
  void report_wait(const Caller& caller, const Request& request);

 private:
  static constexpr std::size_t kBuffered = 100;

  struct Expected {
    int rank;
    std::uint32_t number;
    Request* request;
  };

  void begin_silence();
  std::string awaited(const Caller& caller, const Request& request) const;

  std::optional<std::chrono::milliseconds> patience_;
  std::vector<Expected> expected_;
  std::chrono::steady_clock::time_point quiet_since_;
  bool reported_ = false;
};

}  // namespace mars::messages
