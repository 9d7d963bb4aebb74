// A backend that counts the messages that its rank sends, by sender, receiver and type, and hands them on.
//   Counts counts;
//   run_threads(nodes, host, node, counting(counts));
//   EXPECT_EQ(counts.sent({.from = 0, .type = mars::wire::kTriangles}).messages, ...);
#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>

#include "hal/messages/backend.h"
#include "hal/threads/run_threads.h"

namespace mars::messages {

// Of all ranks; safe to use from all threads.
class Counts {
 public:
  struct Sent {
    std::uint64_t messages = 0;
    std::uint64_t empty = 0;  // of them, without a byte
    std::uint64_t bytes = 0;
  };
  // Which messages: what is not given is any. The host's id is the number of nodes.
  struct Which {
    std::optional<int> from = {};
    std::optional<int> to = {};
    std::optional<int> type = {};
  };

  void add(int from, int to, int type, std::size_t length) {
    const std::lock_guard lock(mutex_);
    Sent& sent = sent_[{from, to, type}];
    ++sent.messages;
    sent.empty += length == 0 ? 1 : 0;
    sent.bytes += length;
  }

  Sent sent(const Which& which) const {
    const std::lock_guard lock(mutex_);
    Sent sum;
    for (const auto& [key, sent] : sent_) {
      const auto& [from, to, type] = key;
      if (which.from.value_or(from) != from || which.to.value_or(to) != to || which.type.value_or(type) != type) {
        continue;
      }
      sum.messages += sent.messages;
      sum.empty += sent.empty;
      sum.bytes += sent.bytes;
    }
    return sum;
  }

  // visit(from, to, type, sent) for all that was sent.
  template <typename Visit>
  void visit(const Visit& visit) const {
    const std::lock_guard lock(mutex_);
    for (const auto& [key, sent] : sent_) std::apply(visit, std::tuple_cat(key, std::tie(sent)));
  }

  void clear() {
    const std::lock_guard lock(mutex_);
    sent_.clear();
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::tuple<int, int, int>, Sent> sent_;  // by from, to, type
};

class CountingBackend : public Backend {
 public:
  CountingBackend(Backend& inner, Counts& counts) : inner_(inner), counts_(counts) {}

  int rank() const override { return inner_.rank(); }
  int nodes() const override { return inner_.nodes(); }
  void send(int to, int type, const void* data, std::size_t length) override {
    counts_.add(rank(), to, type, length);
    inner_.send(to, type, data, length);
  }
  Ticket start_send(int to, int type, const void* data, std::size_t length) override {
    counts_.add(rank(), to, type, length);
    return inner_.start_send(to, type, data, length);
  }
  bool sent(Ticket ticket) override { return inner_.sent(ticket); }
  std::optional<Envelope> peek() override { return inner_.peek(); }
  void take(void* buffer) override { inner_.take(buffer); }
  void idle(int turn, std::chrono::microseconds longest) override { inner_.idle(turn, longest); }
  Neighbourhood neighbourhood() override { return inner_.neighbourhood(); }
  std::shared_ptr<std::byte> share(std::size_t bytes) override { return inner_.share(bytes); }
  Offer offer(std::size_t bytes) override { return inner_.offer(bytes); }
  std::shared_ptr<std::byte> attach(int rank, const MemoryName& name, std::size_t bytes) override {
    return inner_.attach(rank, name, bytes);
  }
  bool finish() override { return inner_.finish(); }
  [[noreturn]] void abort(const std::string& reason) override {
    inner_.abort(reason);
    std::terminate();
  }

 private:
  Backend& inner_;
  Counts& counts_;
};

// For run_threads; `counts` outlives the run.
inline threads::WrapBackend counting(Counts& counts) {
  return [&counts](Backend& backend) { return std::make_unique<CountingBackend>(backend, counts); };
}

}  // namespace mars::messages
