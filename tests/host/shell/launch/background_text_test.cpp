#include "host/shell/launch/background_text.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

#include "topology/memory_limit.h"

namespace mars::launch {
namespace {

std::string wait_for(BackgroundText& text) {
  for (;;) {
    if (const std::string found = text.take(); !found.empty()) return found;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(BackgroundText, IsThereOnceItIsFound) {
  BackgroundText text;
  EXPECT_EQ(text.take(), "");
  text.begin([] { return std::string("found"); });
  EXPECT_EQ(wait_for(text), "found");
  EXPECT_EQ(text.take(), "");
  text.begin([]() -> std::string { throw std::bad_alloc(); });
  EXPECT_NE(wait_for(text).find("no more memory"), std::string::npos);
  EXPECT_EQ(exit_code(7), 7);
}

// In a process of its own: no stack of an ended thread is there to be used again.
TEST(BackgroundTextDeathTest, WithoutAThreadItIsWhy) {
  EXPECT_EXIT(
      {
        rlimit limit{};
        getrlimit(RLIMIT_AS, &limit);
        limit.rlim_cur = topology::process_memory().addresses + (1 << 20);
        setrlimit(RLIMIT_AS, &limit);
        BackgroundText text;
        text.begin([] { return std::string("found"); });
        _exit(text.take().find("the machine gives no more threads") == 0 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(BackgroundTextDeathTest, NothingIsDestroyedWhileItIsLookedFor) {
  EXPECT_EXIT(
      {
        atexit([] { _exit(9); });
        {
          BackgroundText text;
          text.begin([] {
            for (;;) pause();
            return std::string();
          });
        }
        exit(exit_code(3));
      },
      testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace mars::launch
