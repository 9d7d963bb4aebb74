// The backend to copy is a backend: NX's calls work on it, in its world of one node.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "hal/messages/process.h"
#include "hal/messages/shared_memory.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/template/template_backend.h"

namespace mars::transport_template {
namespace {

class Template : public testing::Test {
 protected:
  TemplateBackend backend;
  messages::Process process{backend};
};

TEST_F(Template, IsOneNode) {
  EXPECT_EQ(mynode(), 0);
  EXPECT_EQ(numnodes(), 1);
  EXPECT_NE(myhost(), 0);
}

TEST_F(Template, KeepsOrderAndBytes) {
  for (long i = 0; i < 5; ++i) csend(7, &i, sizeof i, 0, 0);
  csend(8, nullptr, 0, 0, 0);
  for (long expected = 0; expected < 5; ++expected) {
    long value = -1;
    crecv(7, &value, sizeof value);
    EXPECT_EQ(value, expected);
  }
  crecv(-1, nullptr, 0);
  EXPECT_EQ(infotype(), 8);
  EXPECT_EQ(iprobe(-1), 0);
  process.finish();
}

TEST_F(Template, SendsFromWhereItLies) {
  const std::vector<char> sent(100'000, 'x');
  std::vector<char> received(sent.size());
  const long from = irecv(3, received.data(), static_cast<long>(received.size()));
  const long to = isend(3, sent.data(), static_cast<long>(sent.size()), 0, 0);
  msgwait(to);
  msgwait(from);
  EXPECT_EQ(received, sent);
}

TEST_F(Template, TakesPartInGlobalOperations) {
  double value = 2.5, work = 0;
  gsync();
  gdsum(&value, 1, &work);
  EXPECT_EQ(value, 2.5);
}

TEST_F(Template, SharesMemoryWithItself) {
  messages::SharedMemory memory(1000);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory.bytes().data()) % 64, 0u);
  std::memset(memory.bytes().data(), 1, memory.bytes().size());
}

TEST_F(Template, ThrowsAwayAtTheEndWhatNobodyReceived) {
  csend(1, "word", 4, 0, 0);
  process.finish();
  EXPECT_FALSE(backend.peek());
}

TEST(TemplateDeathTest, AbortPrintsTheReason) {
  TemplateBackend backend;
  EXPECT_EXIT(backend.abort("node 0 has had enough"), testing::ExitedWithCode(1), "node 0 has had enough");
}

}  // namespace
}  // namespace mars::transport_template
