// mars-messages: what messages cost over MPI, for mars calibrate: mpirun -n 3 mars-messages. Prints seconds of latency,
// bytes a second, and seconds at each end.
#include <iostream>

#include "hal/mpi/start.h"
#include "hal/nx/nx_messages.h"
#include "host/experiments/message_costs.h"

int main(int argc, char** argv) {
  using namespace mars;
  return mpi::run_mpi(argc, argv, mpi::Role::by_rank, [](int, char**) {
    if (mynode() == myhost()) {
      const experiments::MessageCosts costs = experiments::receive_costs();
      std::cout << costs.latency << ' ' << costs.rate << ' ' << costs.end << '\n';
    } else {
      experiments::exchange_messages();
    }
    return 0;
  });
}
