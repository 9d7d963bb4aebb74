// Node 0 or the host of a job whose other ranks are a test's script, by a clock that waiting moves: a minute of waiting
// takes no time.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/messages/backend.h"

namespace mars::messages {

class TimedBackend : public Backend {
 public:
  using Bytes = std::vector<std::byte>;

  TimedBackend(int rank, int nodes) : rank_(rank), nodes_(nodes) {}

  // Each time that seconds pass; what it hands over has come then.
  std::function<void()> meanwhile;
  double now = 1000;
  struct Sent {
    int to, type;
    double when;
    Bytes bytes;
  };
  std::vector<Sent> sent_messages;

  template <typename Message>
  void hand(int from, int type, const Message& message) {
    Bytes bytes(sizeof message);
    std::memcpy(bytes.data(), &message, sizeof message);
    hand(from, type, std::move(bytes));
  }
  void hand(int from, int type, Bytes bytes) { coming_.push_back({{from, type, bytes.size()}, std::move(bytes)}); }

  int rank() const override { return rank_; }
  int nodes() const override { return nodes_; }
  void send(int to, int type, const void* data, std::size_t length) override {
    const auto* bytes = static_cast<const std::byte*>(data);
    sent_messages.push_back({to, type, now, Bytes(bytes, bytes + length)});
  }
  Ticket start_send(int to, int type, const void* data, std::size_t length) override {
    send(to, type, data, length);
    return 0;
  }
  bool sent(Ticket) override { return true; }
  std::optional<Envelope> peek() override {
    return coming_.empty() ? std::nullopt : std::optional(coming_.front().first);
  }
  void take(void* buffer) override {
    const Bytes& bytes = coming_.front().second;
    std::copy(bytes.begin(), bytes.end(), static_cast<std::byte*>(buffer));
    coming_.pop_front();
  }
  void idle(int, std::chrono::microseconds longest) override {
    now += std::chrono::duration<double>(longest).count();
    if (meanwhile) meanwhile();
  }
  double seconds() const override { return now; }
  Neighbourhood neighbourhood() override { return {rank_, 0, 1, rank_, false, ""}; }
  std::shared_ptr<std::byte> share(std::size_t) override { return nullptr; }
  Offer offer(std::size_t) override { return {}; }
  std::shared_ptr<std::byte> attach(int, const MemoryName&, std::size_t) override { return nullptr; }
  bool finish() override { return true; }
  [[noreturn]] void abort(const std::string&) override { std::terminate(); }

 private:
  const int rank_;
  const int nodes_;
  std::deque<std::pair<Envelope, Bytes>> coming_;
};

}  // namespace mars::messages
