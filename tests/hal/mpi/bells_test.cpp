// Bells over MPI, at as many nodes as the job has (mpi_main.cpp).
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "hal/nx/nx_messages.h"

namespace mars::mpi {
namespace {

constexpr int kRounds = 15;
constexpr int kTries = 5;

void sleep_before(int round) { std::this_thread::sleep_for(std::chrono::milliseconds(100 + round % 7)); }

double median(std::vector<double> delays) {
  std::ranges::sort(delays);
  return delays[delays.size() / 2];
}

// Seconds from a message to the rank that waits for it.
double delay_of_messages() {
  std::vector<double> delays;
  for (int round = 0; round < kRounds; ++round) {
    double sent = 0;
    crecv(round % 2 == 0 ? 1 : -1, &sent, sizeof sent);
    delays.push_back(dclock() - sent);  // one machine's clock
  }
  return median(delays);
}

void send_messages() {
  for (int round = 0; round < kRounds; ++round) {
    sleep_before(round);
    const double now = dclock();
    csend(1, &now, sizeof now, 0, 0);
  }
}

// Seconds until this machine, which may be busy, lets a thread run that another has woken.
double delay_of_threads() {
  std::vector<double> delays;
  std::mutex mutex;
  std::condition_variable rung;
  double sent = 0;
  for (int round = 0; round < kRounds; ++round) {
    std::unique_lock lock(mutex);
    sent = 0;
    std::thread ringer([&] {
      sleep_before(round);
      const std::lock_guard guard(mutex);
      sent = dclock();
      rung.notify_one();
    });
    rung.wait(lock, [&] { return sent > 0; });
    delays.push_back(dclock() - sent);
    lock.unlock();
    ringer.join();
  }
  return median(delays);
}

// A rank that has waited long sleeps up to ten milliseconds at a time: a bell that was not heard would cost five of
// them.
TEST(Bells, ASleeperWakesAtOnce) {
  constexpr double kAtOnce = 0.002;
  long heard = 0;
  for (int tries = 0; tries < kTries && !heard; ++tries) {
    if (mynode() == myhost()) {
      send_messages();
      crecv(2, &heard, sizeof heard);
    } else if (mynode() == 0) {
      heard = delay_of_messages() < delay_of_threads() + kAtOnce;
      csend(2, &heard, sizeof heard, myhost(), 0);
    } else {
      heard = 1;
    }
  }
  EXPECT_TRUE(heard);
}

}  // namespace
}  // namespace mars::mpi
