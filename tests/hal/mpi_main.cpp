// The main function of tests under MPI: all ranks run all tests in the same order, rank 0 as the host. A
// failure on any rank is printed by that rank and ends the job, so that none waits for one that gave up.
#include <string>

#include <gtest/gtest.h>

#include "hal/messages/process.h"
#include "hal/mpi/start.h"

namespace mars::messages {
namespace {

class EndJobOnFailure : public testing::EmptyTestEventListener {
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    Backend& backend = process().backend();
    const char* file = result.file_name() == nullptr ? "?" : result.file_name();
    backend.abort(rank_name(backend.rank(), backend.host()) + " of " + std::to_string(backend.nodes()) +
                  " nodes: " + file + ":" + std::to_string(result.line_number()) + ": " + result.message());
  }
};

int run_tests(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  const Backend& backend = process().backend();
  if (backend.rank() != backend.host()) delete listeners.Release(listeners.default_result_printer());
  listeners.Append(new EndJobOnFailure);
  return RUN_ALL_TESTS();
}

}  // namespace
}  // namespace mars::messages

int main(int argc, char** argv) {
  return mars::mpi::run_mpi(argc, argv, mars::mpi::Role::by_rank, mars::messages::run_tests);
}
