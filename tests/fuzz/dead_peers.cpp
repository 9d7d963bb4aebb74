#include "tests/fuzz/dead_peers.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "hal/messages/pages.h"

namespace mars::fuzz {
void DeadPeers::send(int to, int type, const void* data, std::size_t length) {
  ++sent_;
  if (to != rank_) return;
  const auto* const bytes = static_cast<const std::byte*>(data);
  coming_.push_back({rank_, type, {bytes, bytes + length}, 0});
}

messages::Ticket DeadPeers::start_send(int to, int type, const void* data, std::size_t length) {
  send(to, type, data, length);
  return 0;
}

std::optional<messages::Envelope> DeadPeers::peek() {
  if (!has_come()) return std::nullopt;
  const Letter& next = coming_.front();
  return messages::Envelope{next.from, next.type, next.body.size()};
}

void DeadPeers::take(void* buffer) {
  std::ranges::copy(coming_.front().body, static_cast<std::byte*>(buffer));
  coming_.pop_front();
  waited_for_ = false;
}

void DeadPeers::idle(int, std::chrono::microseconds) {
  if (coming_.empty()) throw NothingComes();
  waited_for_ = true;
}

messages::Neighbourhood DeadPeers::neighbourhood() { return {rank_, 0, 1, rank_, false}; }

std::shared_ptr<std::byte> DeadPeers::share(std::size_t bytes) {
  std::shared_ptr<std::byte> block = messages::map_pages(bytes);
  if (block == nullptr) throw messages::too_much_to_share(bytes, "");
  return block;
}

messages::Offer DeadPeers::offer(std::size_t bytes) { return {{{1, 2, 3, 4}}, messages::map_pages(bytes)}; }

std::shared_ptr<std::byte> DeadPeers::attach(int rank, const messages::MemoryName&, std::size_t bytes) {
  const auto seen = seen_.find(rank);
  return seen != seen_.end() && bytes <= seen->second.second ? seen->second.first : nullptr;
}

void DeadPeers::abort(const std::string& reason) {
  std::fprintf(stderr, "%s\n", reason.c_str());
  std::abort();
}

}  // namespace mars::fuzz
