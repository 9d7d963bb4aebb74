// The message that a probe finds is the one that the next receive takes, also when messages arrive between two looks.
#include <gtest/gtest.h>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/matching/scripted_backend.h"

namespace mars::messages {
namespace {

// Nothing is there at the first look; right after it three messages of one type are.
TEST(Probe, FindsTheMessageThatIsReceivedNext) {
  ScriptedBackend backend;
  for (const std::size_t length : {10, 20, 30}) backend.hand(1, 7, ScriptedBackend::Bytes(length));
  backend.be_blind(1);
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
