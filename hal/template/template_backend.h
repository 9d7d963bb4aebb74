// A backend to copy when NX shall travel by other means. It is whole, but its world is as small as can be: one
// node, whose messages go to itself. docs/porting-backends.md goes through it step by step; backend.h is the
// contract; what a body would do in a world of many ranks stands beside it in the .cpp file.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "hal/messages/backend.h"
#include "hal/messages/message_pool.h"

namespace mars::transport_template {

class TemplateBackend : public messages::Backend {
 public:
  int rank() const override { return 0; }
  int nodes() const override { return 1; }
  bool has_host() const override { return false; }

  void send(int to, int type, const void* data, std::size_t length) override;
  messages::Ticket start_send(int to, int type, const void* data, std::size_t length) override;
  bool sent(messages::Ticket ticket) override;

  std::optional<messages::Envelope> peek() override;
  void take(void* buffer) override;
  void idle(int turn, std::chrono::microseconds longest) override;

  messages::Neighbourhood neighbourhood() override;
  std::shared_ptr<std::byte> share(std::size_t bytes) override;
  messages::Offer offer(std::size_t bytes) override;
  std::shared_ptr<std::byte> attach(int rank, const messages::MemoryName& name, std::size_t bytes) override;

  bool finish() override;
  [[noreturn]] void abort(const std::string& reason) override;

 private:
  messages::MessagePool pool_;
  messages::MessageList arrived_;  // in order of arrival
};

}  // namespace mars::transport_template
