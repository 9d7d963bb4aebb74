// A transport whose host receives some strips slowly: their bytes come long after their envelopes.
#pragma once

#include <chrono>
#include <cstring>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "node/wire/protocol.h"
#include "tests/hal/counting_backend.h"

namespace mars::farm {

// Of node 1 every strip but its frame's last takes a while.
class SlowLink : public messages::CountingBackend {
 public:
  using CountingBackend::CountingBackend;

  std::optional<messages::Ticket> start_take(void* buffer) override {
    const messages::Envelope next = *peek();
    if (rank() != host() || next.type != wire::kStrip || next.from != 1) return CountingBackend::start_take(buffer);
    Coming coming{buffer, std::vector<std::byte>(next.length), Clock::now()};
    take(coming.bytes.data());
    wire::Strip header;
    std::memcpy(&header, coming.bytes.data(), sizeof header);
    if (header.last == 0) coming.when += std::chrono::milliseconds(50);
    coming_.emplace(++last_, std::move(coming));
    return last_;
  }

  bool sent(messages::Ticket ticket) override {
    const auto found = coming_.find(ticket);
    if (found == coming_.end()) return CountingBackend::sent(ticket);
    const Coming& coming = found->second;
    if (Clock::now() < coming.when) return false;
    std::memcpy(coming.buffer, coming.bytes.data(), coming.bytes.size());
    coming_.erase(found);
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Coming {
    void* buffer;
    std::vector<std::byte> bytes;
    Clock::time_point when;
  };

  std::map<messages::Ticket, Coming> coming_;
  messages::Ticket last_ = 1 << 20;  // not one of the transport's
};

}  // namespace mars::farm
