// A backend of one rank, node 0 of three, to which a test hands messages as if others had sent them.
#pragma once

#include <algorithm>
#include <chrono>
#include <deque>
#include <exception>
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

  void hand(int from, int type, Bytes bytes) { coming_.push_back({{from, type, bytes.size()}, std::move(bytes)}); }

  int rank() const override { return 0; }
  int nodes() const override { return 3; }
  void send(int, int, const void*, std::size_t) override {}
  Ticket start_send(int, int, const void*, std::size_t) override { return 0; }
  bool sent(Ticket) override { return true; }
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
  void idle(int, std::chrono::microseconds) override { throw std::logic_error("the call waits for ever"); }
  Neighbourhood neighbourhood() override { return {}; }
  std::shared_ptr<std::byte> share(std::size_t) override { return nullptr; }
  Offer offer(std::size_t) override { return {}; }
  std::shared_ptr<std::byte> attach(int, const MemoryName&, std::size_t) override { return nullptr; }
  bool finish() override { return true; }
  [[noreturn]] void abort(const std::string&) override { std::terminate(); }

 private:
  int blind_ = 0;
  std::deque<std::pair<Envelope, Bytes>> coming_;
};

}  // namespace mars::messages
