// A backend to copy when NX shall travel by other means. It is whole, but its world is as small as can be: one
// node, whose messages go to itself. docs/porting-backends.md goes through it step by step; backend.h is the
// contract; what a body would do in a world of many ranks stands beside it in the .cpp file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "hal/messages/backend.h"
#include "hal/messages/message_pool.h"

namespace mars::hal {

class TemplateBackend : public Backend {
 public:
  int rank() const override { return 0; }
  int nodes() const override { return 1; }
  bool has_host() const override { return false; }

  void send(int to, int type, const void* data, std::size_t length) override;
  Ticket start_send(int to, int type, const void* data, std::size_t length) override;
  bool sent(Ticket ticket) override;

  std::optional<Envelope> peek() override;
  void take(void* buffer) override;
  void idle(int turn, std::chrono::microseconds longest) override;

  Neighbourhood neighbourhood() override;
  std::shared_ptr<std::byte> share(std::size_t bytes) override;

  bool finish() override;
  [[noreturn]] void abort(const std::string& reason) override;

 private:
  MessagePool pool_;
  MessageList arrived_;  // in order of arrival
};

}  // namespace mars::hal
