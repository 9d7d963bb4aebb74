// What a probe tells of is what the next receive takes, also when messages arrive between two looks.
#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"

namespace mars::messages {
namespace {

// Nothing is there at the first look; right after it three messages of one type are.
class BlinkingBackend : public Backend {
 public:
  int rank() const override { return 0; }
  int nodes() const override { return 1; }
  void send(int, int, const void*, std::size_t) override {}
  Ticket start_send(int, int, const void*, std::size_t) override { return 0; }
  bool sent(Ticket) override { return true; }
  std::optional<Envelope> peek() override {
    if (looks_++ == 0 || messages_.empty()) return std::nullopt;
    return messages_.front();
  }
  void take(void*) override { messages_.pop_front(); }
  void idle(int, std::chrono::microseconds) override {}
  Neighbourhood neighbourhood() override { return {}; }
  std::shared_ptr<std::byte> share(std::size_t) override { return nullptr; }
  bool finish() override { return true; }
  [[noreturn]] void abort(const std::string&) override { std::terminate(); }

 private:
  std::deque<Envelope> messages_ = {{1, 7, 10}, {1, 7, 20}, {1, 7, 30}};
  int looks_ = 0;
};

TEST(Probe, TellsOfTheMessageThatIsReceivedNext) {
  BlinkingBackend backend;
  Process process(backend);
  char buffer[100];
  for (const long expected : {10, 20, 30}) {
    while (iprobe(7) == 0) {
    }
    EXPECT_EQ(infocount(), expected);
    crecv(7, buffer, sizeof buffer);
    EXPECT_EQ(infocount(), expected);
  }
}

}  // namespace
}  // namespace mars::messages
