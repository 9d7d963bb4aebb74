// NX over processes of one machine, each rank forked for each test: a failure in any of them is the test's.
#include <tuple>

#include <gtest/gtest.h>

#include "hal/failure.h"
#include "hal/processes/run_processes.h"
#include "tests/hal/nx_bodies.h"

namespace mars::hal {
namespace {

class NxProcesses : public testing::TestWithParam<std::tuple<NxBody, int>> {};

TEST_P(NxProcesses, Holds) {
  const auto [body, nodes] = GetParam();
  // A rank that gives up must not leave the others waiting.
  const auto run = [body = body] {
    body.run();
    if (testing::Test::HasFatalFailure()) throw Failure("a rank gave up", "", "");
    meet();
    return testing::Test::HasFailure() ? 1 : 0;
  };
  EXPECT_EQ(run_processes(nodes, run, run), 0);
}

constexpr auto name_of = [](const auto& info) {
  return std::string(std::get<0>(info.param).name) + "_" + std::to_string(std::get<1>(info.param));
};
const auto some_nodes = testing::Values(1, 2, 3, 4, 7, 8, 16, 32);

INSTANTIATE_TEST_SUITE_P(Handlers, NxProcesses, testing::Combine(testing::ValuesIn(handlers_bodies()), some_nodes),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Messages, NxProcesses, testing::Combine(testing::ValuesIn(messages_bodies()), some_nodes),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Globals, NxProcesses, testing::Combine(testing::ValuesIn(global_bodies()), some_nodes), name_of);

}  // namespace
}  // namespace mars::hal
