// The rules over simulated machines.
#include <gtest/gtest.h>

#include "hal/simulated/run_simulated.h"
#include "tests/hal/conformance/rules.h"

namespace mars::conformance {
namespace {

simulated::Machine hypercube() {
  simulated::Machine machine;
  machine.host_apart = true;
  machine.network = {.topology = simulated::Topology::hypercube, .hop = 30e-6, .byte = 1 / 2.8e6};
  machine.network.send = machine.network.receive = {{0, 175e-6}, {101, 330e-6}};
  return machine;
}

simulated::Machine cluster() {
  simulated::Machine machine{.nodes = 32, .processors = 2};
  machine.network = {.latency = 2e-6, .byte = 1e-10, .local_latency = 2e-7, .local_byte = 1e-10};
  return machine;
}

class Simulated : public testing::TestWithParam<int> {};

TEST_P(Simulated, HoldOnAHypercube) {
  simulated::run_simulated(
      hypercube(), GetParam(), [](simulated::World&) { run_rules(); }, run_rules);
}

TEST_P(Simulated, HoldOnACluster) {
  simulated::run_simulated(
      cluster(), GetParam(), [](simulated::World&) { run_rules(); }, run_rules);
}

// Every message that is not empty.
TEST_P(Simulated, HoldWhereMessagesAreAnnounced) {
  simulated::Machine machine = cluster();
  machine.nodes = 1;
  machine.network.eager = 0;
  simulated::run_simulated(
      machine, GetParam(), [](simulated::World&) { run_rules(); }, run_rules);
}

INSTANTIATE_TEST_SUITE_P(Rules, Simulated, testing::Values(1, 2, 3, 4, 7, 8, 16, 32));

}  // namespace
}  // namespace mars::conformance
