// One rank of a simulated job (world.h) as a backend. A message is copied once, on its way; what it costs is charged.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/messages/backend.h"
#include "hal/messages/pages.h"
#include "hal/simulated/world.h"

namespace mars::simulated {

class SimulatedBackend : public messages::Backend {
 public:
  SimulatedBackend(World& world, int rank) : world_(world), rank_(rank) {}

  int rank() const override { return rank_; }
  int nodes() const override { return world_.nodes(); }
  void send(int to, int type, const void* data, std::size_t length) override;
  messages::Ticket start_send(int to, int type, const void* data, std::size_t length) override;
  bool sent(messages::Ticket ticket) override;
  std::optional<messages::Envelope> peek() override { return world_.peek(rank_); }
  void take(void* buffer) override { world_.take(rank_, buffer); }
  std::optional<messages::Ticket> start_take(void* buffer) override;
  void idle(int turn, std::chrono::microseconds longest) override;
  double seconds() const override { return world_.clock(rank_); }
  bool has_machine_clock() const override { return false; }
  void charge(int kind, std::uint64_t units) override;
  void keep_to(int first, int count) override { world_.keep_to(rank_, first, count); }
  void discard(std::span<std::byte> bytes) override { messages::give_pages_back(bytes); }
  messages::MessagePool* pool() override { return &world_.pool(); }
  messages::Neighbourhood neighbourhood() override;
  std::shared_ptr<std::byte> share(std::size_t bytes) override;
  std::shared_ptr<std::byte> replica(std::uint64_t key, std::size_t bytes) override;
  messages::Offer offer(std::size_t bytes) override;
  std::shared_ptr<std::byte> attach(int rank, const messages::MemoryName& name, std::size_t bytes) override;
  bool finish() override;
  [[noreturn]] void abort(const std::string& reason) override;

 private:
  World& world_;
  const int rank_;
  std::vector<World::Taken> coming_;  // and not yet there; of a free place, never
  int shared_ = 0;                    // blocks of shared memory so far
  bool finishing_ = false;
};

}  // namespace mars::simulated
