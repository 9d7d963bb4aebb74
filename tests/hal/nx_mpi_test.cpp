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

constexpr auto name_of = [](const auto& info) { return std::string(info.param.name); };

INSTANTIATE_TEST_SUITE_P(Handlers, NxMpi, testing::ValuesIn(handlers_bodies()), name_of);
INSTANTIATE_TEST_SUITE_P(Messages, NxMpi, testing::ValuesIn(messages_bodies()), name_of);
INSTANTIATE_TEST_SUITE_P(Globals, NxMpi, testing::ValuesIn(global_bodies()), name_of);

}  // namespace
}  // namespace mars::hal
