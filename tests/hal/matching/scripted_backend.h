// A backend of one rank, node 0 of three, to which a test hands messages as if others had sent them.
#pragma once

#include <algorithm>
#include <chrono>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hal/messages/backend.h"

namespace mars::messages {

class ScriptedBackend : public Backend {
 public:
  using Bytes = std::vector<unsigned char>;

  // The next `looks` looks see nothing of what is there.
  void be_blind(int looks) { blind_ = looks; }

  // The bytes of messages of this rank come only with bring().
  void be_slow(int from) { slow_ = from; }
  void bring() {
    for (const auto& [buffer, bytes] : std::exchange(on_the_way_, {}))
      std::copy(bytes.begin(), bytes.end(), static_cast<unsigned char*>(buffer));
    ++brought_;
  }
  // What a call that waits does instead of waiting for ever.
  std::function<void()> meanwhile;

  void hand(int from, int type, Bytes bytes) { coming_.push_back({{from, type, bytes.size()}, std::move(bytes)}); }

  int rank() const override { return 0; }
  int nodes() const override { return 3; }
  void send(int, int, const void*, std::size_t) override {}
  Ticket start_send(int, int, const void*, std::size_t) override { return 0; }
  std::optional<Ticket> start_take(void* buffer) override {
    if (coming_.front().first.from == slow_) {
      on_the_way_.emplace_back(buffer, std::move(coming_.front().second));
      coming_.pop_front();
      return brought_;
    }
    take(buffer);
    return std::nullopt;
  }
  bool sent(Ticket ticket) override { return ticket < brought_; }
  std::optional<Envelope> peek() override {
    if (coming_.empty() || blind_-- > 0) return std::nullopt;
    return coming_.front().first;
  }
  void take(void* buffer) override {
    const Bytes& bytes = coming_.front().second;
    std::copy(bytes.begin(), bytes.end(), static_cast<unsigned char*>(buffer));
    coming_.pop_front();
  }
  // Nobody sends while the rank waits.
  void idle(int, std::chrono::microseconds) override {
    if (!meanwhile) throw std::logic_error("the call waits for ever");
    meanwhile();
  }
  Neighbourhood neighbourhood() override { return {}; }
  std::shared_ptr<std::byte> share(std::size_t) override { return nullptr; }
  Offer offer(std::size_t) override { return {}; }
  std::shared_ptr<std::byte> attach(int, const MemoryName&, std::size_t) override { return nullptr; }
  bool finish() override { return true; }
  [[noreturn]] void abort(const std::string&) override { std::terminate(); }

 private:
  int blind_ = 0;
  int slow_ = -1;
  Ticket brought_ = 1;  // tickets below it
  std::vector<std::pair<void*, Bytes>> on_the_way_;
  std::deque<std::pair<Envelope, Bytes>> coming_;
};

}  // namespace mars::messages
