// How C programs fail: by a plain call, which ends them, or by its twin, which does not.
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "hal/nx/guard.h"
#include "hal/nx/nx_messages.h"
#include "hal/threads/run_threads.h"

namespace mars::nx {
namespace {

void end_here(const std::string& reason) {
  std::fprintf(stderr, "%s\n", reason.c_str());
  std::_Exit(3);
}

void as_a_c_program(const std::function<void()>& body) {
  end_program_on_failure(end_here);
  threads::run_threads(
      2, [] {},
      [&body] {
        if (mynode() == 1) body();
      });
  std::_Exit(0);
}

TEST(Guard, PlainCallsEndCPrograms) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(as_a_c_program([] { csend(1, nullptr, -4, 0, 0); }), testing::ExitedWithCode(3),
              "node 1, csend: length -4 is negative");
  EXPECT_EXIT(as_a_c_program([] { msgwait(7); }), testing::ExitedWithCode(3),
              "node 1, msgwait: there is no message id 7");
}

TEST(Guard, TwinsDoNotAndNxPerrorPrintsThem) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(as_a_c_program([] {
                nx_perror("first");
                _csend(1, nullptr, -4, 0, 0);
                nx_perror("then");
              }),
              testing::ExitedWithCode(0), "first: no call has failed\nthen: node 1, csend: length -4 is negative");
}

TEST(Guard, AnotherRanksEndIsNoErrno) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  const auto stopped = [] {
    end_program_on_failure(end_here);
    threads::run_threads(
        1, [] { throw Failure("the host is gone", "", ""); }, [] { _crecv(1, nullptr, 0); });
  };
  EXPECT_EXIT(stopped(), testing::ExitedWithCode(3), "the host is gone");
}

}  // namespace
}  // namespace mars::nx
