// The counts of one process's messages, and, where it is recorded (recorder.h), their events.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hal/messages/backend.h"
#include "hal/messages/events.h"

namespace mars::messages {

// The messages that a process has sent, those inside collectives included.
struct Traffic {
  struct Count {
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
  };
  Count to_nodes;
  Count to_host;
};

class Ledger {
 public:
  explicit Ledger(int host) : host_(host), numbers_(static_cast<std::size_t>(host) + 1) {}

  // Each message has a number among all from its sender to its receiver, the same for both.
  std::uint32_t sent(const Envelope& to, double begin);
  std::uint32_t taken(const Envelope& envelope) { return numbers_[static_cast<std::size_t>(envelope.from)].taken++; }
  // All of it is here.
  void record_taken(const Envelope& envelope, double begin, std::uint32_t number);
  // Numbers begin again.
  void forget(int rank) { numbers_[static_cast<std::size_t>(rank)] = {}; }
  void waited(const Envelope& came, double begin);

  // The time to give as `begin`: 0 without a recorder.
  double begin() const;

  const Traffic& traffic() const { return traffic_; }
  EventBuffer* recorder() const { return recorder_; }
  void record(EventBuffer* recorder) { recorder_ = recorder; }

 private:
  struct Numbers {
    std::uint32_t sent = 0;
    std::uint32_t taken = 0;
  };

  int host_;
  std::vector<Numbers> numbers_;  // by rank
  Traffic traffic_;
  EventBuffer* recorder_ = nullptr;
};

}  // namespace mars::messages
