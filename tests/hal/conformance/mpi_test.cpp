// The rules over MPI, at as many nodes as the job has (tests/hal/mpi_main.cpp).
#include <gtest/gtest.h>

#include "tests/hal/conformance/rules.h"

namespace mars::conformance {
namespace {

TEST(Rules, HoldOverMpi) { run_rules(); }

}  // namespace
}  // namespace mars::conformance
