// Work in a process of its own: what it says comes back; dying, never ending and taking all memory are one failure.
#include "host/content/importer/apart.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <vector>

#include "hal/failure/failure.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/sanitizers/sanitized.h"

namespace mars::importer {
namespace {

using namespace std::chrono_literals;

constexpr ApartLimits kLimits{5s, 60s, std::uint64_t{256} << 20};

std::string apart(const std::function<std::string()>& work, const ApartLimits& limits = kLimits) {
  return run_apart([&] { return std::vector{work()}; }, limits, "a file", "mend it");
}

std::string failure(const std::function<std::string()>& work, const ApartLimits& limits = kLimits) {
  const std::string text = document::failure_of([&] { apart(work, limits); });
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no process is left behind";
  return text;
}

TEST(Apart, WhatItSaysComesBack) {
  EXPECT_EQ(apart([] { return std::string("done"); }), "done");
  const std::string much(1 << 20, 'x');
  EXPECT_EQ(apart([&] { return much; }), much);
}

TEST(Apart, ItsPartsAreJoined) {
  const std::string much(1 << 18, 'x');
  const auto work = [&] { return std::vector<std::string>{"a", "", much, "b"}; };
  EXPECT_EQ(run_apart(work, kLimits, "a file", "mend it"), "a" + much + "b");
}

TEST(Apart, ItsFailureIsOurs) {
  EXPECT_EQ(failure([]() -> std::string { throw Failure("is bad", "b", "look at it"); }), "b: is bad (look at it)");
  EXPECT_EQ(failure([]() -> std::string { throw std::runtime_error("odd"); }),
            "a file: MARS did not expect this: odd (please report it with the command)");
}

TEST(Apart, DyingIsTold) {
  EXPECT_EQ(failure([] { return raise(SIGKILL), std::string(); }),
            "a file: cannot be read: its reader crashed (mend it)");
  EXPECT_EQ(failure([]() -> std::string { _exit(1); }),
            "a file: cannot be read: its reader ended with code 1 (mend it)");
}

TEST(Apart, NeverEndingIsTold) {
  const auto endless = [] {
    for (volatile bool on = true; on;) {
    }
    return std::string();
  };
  EXPECT_EQ(failure(endless, {1s, 60s, kLimits.memory}),
            "a file: takes more than 1 s of processor time to read (mend it)");
  const auto asleep = [] { return pause(), std::string(); };
  EXPECT_EQ(failure(asleep, {5s, 200ms, kLimits.memory}), "a file: takes more than 1 s to read (mend it)");
}

TEST(Apart, TakingAllMemoryIsTold) {
  if (sanitizers::kSanitized) GTEST_SKIP() << "a sanitizer ends a process that gets no memory";
  const auto greedy = [] {
    std::vector<std::vector<char>> all;
    for (;;) all.emplace_back(1 << 20);
    return std::string();
  };
  EXPECT_EQ(failure(greedy), "a file: takes more than 256 MiB of memory to read (mend it)");
}

}  // namespace
}  // namespace mars::importer
