// NX over MPI, at as many nodes as the job has (see mpi_main.cpp).
#include <string>

#include <gtest/gtest.h>

#include "tests/hal/nx_bodies.h"

namespace mars::hal {
namespace {

class NxMpi : public testing::TestWithParam<NxBody> {};

TEST_P(NxMpi, Holds) {
  GetParam().run();
  meet();
}

INSTANTIATE_TEST_SUITE_P(All, NxMpi, testing::ValuesIn(nx_bodies()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace mars::hal
