// Storms over simulated machines: fixed ones, and a fresh one a run (GTEST_RANDOM_SEED=n runs a certain one instead).
#include <gtest/gtest.h>

#include "hal/simulated/run_simulated.h"
#include "tests/hal/storm/storm.h"

namespace mars::storm {
namespace {

// Few processors and slow links, so that messages meet.
simulated::Machine cluster() {
  simulated::Machine machine{.nodes = 3, .processors = 2};
  machine.network = {
      .topology = simulated::Topology::fat_tree, .latency = 5e-6, .byte = 1e-8, .uplink = 2e-8, .leaf = 2};
  machine.network.send = machine.network.receive = {{0, 1e-6}, {1000, 3e-6}};
  return machine;
}

class Simulated : public testing::TestWithParam<int> {};

TEST_P(Simulated, KeepTheRules) {
  simulated::run_simulated(
      cluster(), GetParam(), [](simulated::World&) { run_fixed_storms(); }, run_fixed_storms);
}

TEST_P(Simulated, KeepTheRulesFresh) {
  const auto rank = [] { run_fresh_storm(static_cast<std::uint32_t>(GTEST_FLAG_GET(random_seed))); };
  simulated::run_simulated(
      cluster(), GetParam(), [&](simulated::World&) { rank(); }, rank);
}

INSTANTIATE_TEST_SUITE_P(Storms, Simulated, testing::Values(1, 2, 3, 7, 16));

}  // namespace
}  // namespace mars::storm
