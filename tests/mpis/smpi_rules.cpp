// The rules over ranks that SimGrid simulates.
#include "hal/mpi/start.h"
#include "tests/hal/conformance/rules.h"

int main(int argc, char** argv) {
  return mars::hal::run_mpi(argc, argv, mars::hal::Role::by_rank, [](int, char**) {
    mars::hal::conformance::run_rules();
    return 0;
  });
}
