// NX over threads.
#include <tuple>

#include <gtest/gtest.h>

#include "hal/failure.h"
#include "hal/threads/run_threads.h"
#include "tests/hal/nx_bodies.h"

namespace mars::hal {
namespace {

class NxThreads : public testing::TestWithParam<std::tuple<NxBody, int>> {};

TEST_P(NxThreads, Holds) {
  const auto [body, nodes] = GetParam();
  // A rank that gives up must not leave the others waiting.
  const auto run = [body = body] {
    body.run();
    if (testing::Test::HasFatalFailure()) throw Failure("a rank gave up", "", "");
    meet();
  };
  run_threads(nodes, run, run);
}

constexpr auto name_of = [](const auto& info) {
  return std::string(std::get<0>(info.param).name) + "_" + std::to_string(std::get<1>(info.param));
};
const auto some_nodes = testing::Values(1, 2, 3, 5, 8);

INSTANTIATE_TEST_SUITE_P(Handlers, NxThreads, testing::Combine(testing::ValuesIn(handlers_bodies()), some_nodes),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Messages, NxThreads, testing::Combine(testing::ValuesIn(messages_bodies()), some_nodes),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Globals, NxThreads,
                         testing::Combine(testing::ValuesIn(global_bodies()), testing::Values(1, 2, 3, 4, 5, 7, 8, 16, 32)),
                         name_of);

}  // namespace
}  // namespace mars::hal
