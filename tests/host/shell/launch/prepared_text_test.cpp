#include "host/shell/launch/prepared_text.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <thread>

#include "hal/failure/failure.h"

namespace mars::launch {
namespace {

std::string wait_for(PreparedText& text) {
  for (;;) {
    if (const auto found = text.take()) return *found;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(PreparedText, IsThereOnceAnotherProcessHasFoundIt) {
  PreparedText text([] { return std::to_string(getpid()) + std::string(100000, 'x'); });
  EXPECT_FALSE(text.take());
  text.begin();
  const std::string found = wait_for(text);
  EXPECT_EQ(found.size(), found.find('x') + 100000);
  EXPECT_NE(found.substr(0, found.find('x')), std::to_string(getpid()));
  EXPECT_FALSE(text.take());
}

TEST(PreparedText, WhereItFailsItIsWhy) {
  PreparedText text([]() -> std::string { throw Failure("names no host", "hosts", ""); });
  text.begin();
  EXPECT_EQ(wait_for(text), "\nhosts: names no host");
}

TEST(PreparedText, EndsUnaskedOrUnfinished) {
  const PreparedText unasked([] { return std::string("found"); });
  PreparedText unfinished([]() -> std::string {
    for (;;) pause();
  });
  unfinished.begin();
  EXPECT_FALSE(unfinished.take());
}

}  // namespace
}  // namespace mars::launch
