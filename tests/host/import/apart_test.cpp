// Work in a process of its own: what it says comes back; dying or never ending is one failure.
#include "host/import/apart.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>

#include "tests/host/document/failure_of.h"

namespace mars::host {
namespace {

using namespace std::chrono_literals;

const Failure kLost("was lost", "some file", "try another");

TEST(Apart, WhatItSaysComesBack) {
  EXPECT_EQ(run_apart([] { return std::string("done"); }, 5s, kLost), "done");
  const std::string much(1 << 20, 'x');
  EXPECT_EQ(run_apart([&] { return much; }, 5s, kLost), much);
}

TEST(Apart, ItsFailureIsOurs) {
  const auto failing = [] { return run_apart([]() -> std::string { throw Failure("is bad", "a file", "mend it"); }, 5s, kLost); };
  EXPECT_EQ(failure_of(failing), std::string(Failure("is bad", "a file", "mend it").what()));
  const auto other = [] { return run_apart([]() -> std::string { throw std::runtime_error("odd"); }, 5s, kLost); };
  EXPECT_TRUE(holds(failure_of(other), "odd"));
}

TEST(Apart, DyingAndNeverEndingAreToldOnce) {
  const auto dying = [] { return run_apart([] { return raise(SIGKILL), std::string(); }, 5s, kLost); };
  EXPECT_TRUE(holds(failure_of(dying), "was lost"));
  const auto endless = [] {
    return run_apart([] {
      for (volatile bool on = true; on;) {
      }
      return std::string();
    }, 1s, kLost);
  };
  EXPECT_TRUE(holds(failure_of(endless), "was lost"));
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no process is left behind";
}

}  // namespace
}  // namespace mars::host
