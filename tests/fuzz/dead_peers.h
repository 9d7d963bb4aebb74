// The other ranks of a job, none of which lives: what they have sent is given beforehand, and what is sent to them is
// forgotten. So one thread alone takes a rank through whatever others may send it.
#pragma once

#include <deque>
#include <map>
#include <utility>

#include "hal/messages/backend.h"
#include "tests/fuzz/edits.h"

namespace mars::fuzz {

struct Letter {
  int from;
  int type;
  Message body;
  std::size_t after = 0;  // messages that the rank has sent before it comes
};

// Thrown by a rank that would wait for a message for ever: the input ends there.
struct NothingComes {};

class DeadPeers : public messages::Backend {
 public:
  DeadPeers(int rank, int nodes) : rank_(rank), nodes_(nodes) {}

  // Letters come in this order; one that would come after more messages than the rank sends, when it waits.
  void hand(Letter letter) { coming_.push_back(std::move(letter)); }
  // Memory of that rank that this one sees by its name; else none is seen.
  void offer_of(int rank, std::shared_ptr<std::byte> memory, std::size_t bytes) { seen_[rank] = {memory, bytes}; }

  int rank() const override { return rank_; }
  int nodes() const override { return nodes_; }
  void send(int to, int type, const void* data, std::size_t length) override;
  messages::Ticket start_send(int to, int type, const void* data, std::size_t length) override;
  bool sent(messages::Ticket) override { return true; }
  std::optional<messages::Envelope> peek() override;
  void take(void* buffer) override;
  void idle(int turn, std::chrono::microseconds longest) override;
  messages::Neighbourhood neighbourhood() override;
  std::shared_ptr<std::byte> share(std::size_t bytes) override;
  messages::Offer offer(std::size_t bytes) override;
  std::shared_ptr<std::byte> attach(int rank, const messages::MemoryName& name, std::size_t bytes) override;
  bool finish() override { return true; }
  [[noreturn]] void abort(const std::string& reason) override;

 private:
  bool has_come() const { return !coming_.empty() && (coming_.front().after <= sent_ || waited_for_); }

  int rank_;
  int nodes_;
  std::size_t sent_ = 0;     // messages of this rank
  bool waited_for_ = false;  // the next letter
  std::deque<Letter> coming_;
  std::map<int, std::pair<std::shared_ptr<std::byte>, std::size_t>> seen_;
};

}  // namespace mars::fuzz
