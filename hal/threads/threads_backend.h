// Ranks as threads of one process: the backend for one machine without MPI, for tests and for programs that
// want host and nodes in one. A message is copied into a buffer of the sender, queued in the receiver's
// mailbox, copied out by the receiver and its buffer given back; waiting is on a condition variable. When the
// world is stopped, every rank's next call throws the failure that stopped it.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hal/messages/backend.h"
#include "hal/messages/message_pool.h"

namespace mars::threads {

class ThreadsWorld;

class ThreadsBackend : public messages::Backend {
 public:
  ThreadsBackend(ThreadsWorld& world, int rank) : world_(world), rank_(rank) {}

  int rank() const override { return rank_; }
  int nodes() const override;
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
  bool finish() override;
  [[noreturn]] void abort(const std::string& reason) override;

  // From any thread: a message of this rank's mailbox or pool; news that end a wait.
  void deliver(messages::Message* message);
  void give_back(messages::Message* message);
  void wake();

 private:
  ThreadsWorld& world_;
  const int rank_;

  // This thread's alone.
  messages::MessagePool pool_;
  messages::MessageList inbox_;  // arrived and seen
  int shared_ = 0;               // blocks of shared memory so far
  bool finishing_ = false;

  std::mutex mutex_;  // of what follows
  std::condition_variable news_;
  bool has_news_ = false;
  messages::MessageList arrived_;
  messages::MessageList returned_;  // of pool_
};

// The state that the ranks share. Outlives their threads.
class ThreadsWorld {
 public:
  explicit ThreadsWorld(int nodes);

  int nodes() const { return static_cast<int>(ranks_.size()) - 1; }
  ThreadsBackend& rank(int rank) { return *ranks_[rank]; }

  // Ends all waits; the first reason counts.
  void stop(std::exception_ptr reason);
  std::exception_ptr failure() const;
  // Throws the reason once stopped: so what the host's thread reports is what happened.
  void check_running() const;

  // Counts a rank that has come to its end; true when all have.
  void finish_one();
  bool finished() const { return finished_ == static_cast<int>(ranks_.size()); }

  // The block that is the `index`-th of every node. Throws Failure on all of them where there is no memory for it.
  std::shared_ptr<std::byte> share(int index, std::size_t bytes);

  messages::Offer offer(int rank, std::size_t bytes);
  std::shared_ptr<std::byte> attach(const messages::MemoryName& name);

 private:
  struct Block {
    std::shared_ptr<std::byte> bytes;  // until every node has it; null: there is no memory for it
    std::size_t size;
    int holders;
  };

  struct Offered {
    messages::MemoryName name;
    std::weak_ptr<std::byte> offer;  // expires when its rank lets go
    std::weak_ptr<std::byte> bytes;  // when all have
  };

  void wake_all();

  std::vector<std::unique_ptr<ThreadsBackend>> ranks_;
  std::atomic<bool> stopped_ = false;
  std::atomic<int> finished_ = 0;
  mutable std::mutex mutex_;  // of what follows
  std::exception_ptr failure_;
  std::deque<Block> blocks_;
  std::vector<Offered> offered_;
  std::uint64_t offers_ = 0;  // so far
};

}  // namespace mars::threads
