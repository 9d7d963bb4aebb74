// Bells over MPI, at as many nodes as the job has (mpi_main.cpp).
#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "hal/nx/nx_messages.h"

namespace mars::mpi {
namespace {

// A rank that has waited long sleeps up to ten milliseconds at a time: a bell that was not heard would cost five of
// them.
TEST(Bells, ASleeperWakesAtOnce) {
  constexpr int kRounds = 9;
  std::vector<double> delays;
  for (int round = 0; round < kRounds; ++round) {
    if (mynode() == myhost()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100 + round % 7));
      const double now = dclock();  // one machine's clock
      csend(1, &now, sizeof now, 0, 0);
    } else if (mynode() == 0) {
      double sent = 0;
      crecv(round % 2 == 0 ? 1 : -1, &sent, sizeof sent);
      delays.push_back(dclock() - sent);
    }
  }
  if (mynode() == 0) {
    std::sort(delays.begin(), delays.end());
    EXPECT_LT(delays[kRounds / 2], 0.003);
  }
}

}  // namespace
}  // namespace mars::mpi
