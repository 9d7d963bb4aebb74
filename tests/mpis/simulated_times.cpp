// The times of messages and collectives on the machine of cluster/platforms/simulate, as hal/simulated has it.
#include <cstdlib>

#include "hal/simulated/run_simulated.h"
#include "tests/mpis/times.h"

namespace {

mars::simulated::Machine hypercube() {
  mars::simulated::Machine machine;
  machine.host_apart = true;
  machine.network = {.topology = mars::simulated::Topology::hypercube, .hop = 30e-6, .byte = 1 / 2.8e6};
  machine.network.send = machine.network.receive = {{0, 175e-6}, {101, 330e-6}};
  return machine;
}

}  // namespace

int main(int, char** argv) {
  mars::simulated::run_simulated(
      hypercube(), std::atoi(argv[1]), [](mars::simulated::World&) {}, mars::times::measure_all);
}
