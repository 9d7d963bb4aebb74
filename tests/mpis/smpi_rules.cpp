// The rules over ranks that SimGrid simulates.
#include "hal/mpi/start.h"
#include "tests/hal/conformance/rules.h"

int main(int argc, char** argv) {
  return mars::mpi::run_mpi(argc, argv, mars::mpi::Role::by_rank, [](int, char**) {
    mars::conformance::run_rules();
    return 0;
  });
}
