#include "tests/hal/storm/storm.h"

#include <cstdio>
#include <exception>
#include <random>
#include <string>

#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/storm/rank.h"

namespace mars::storm {
namespace {

constexpr int kRounds = 4;
constexpr long kSeed = 999'000'003;

}  // namespace

void run_storm(std::uint32_t seed) {
  int round = 0;
  try {
    Rank rank(seed);
    for (; round < kRounds; ++round) rank.run(round);
  } catch (const std::exception& broken) {
    throw Failure(broken.what(),
                  "storm " + std::to_string(seed) + ", round " + std::to_string(round) + ", rank " +
                      std::to_string(mynode()) + " of " + std::to_string(numnodes()) + " nodes and the host",
                  "GTEST_RANDOM_SEED=" + std::to_string(seed) + " makes the test of a fresh seed run it again");
  }
}

void run_fixed_storms() {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) run_storm(seed);
}

void run_fresh_storm(std::uint32_t wanted) {
  std::uint32_t seed = wanted;
  if (mynode() != myhost()) {
    crecv(kSeed, &seed, sizeof seed);
  } else {
    if (seed == 0) seed = std::random_device()() % 99'999 + 1;  // as many as GoogleTest lets one ask for
    std::printf("storm %u at %ld nodes\n", seed, numnodes());
    std::fflush(stdout);
    csend(kSeed, &seed, sizeof seed, -1, 0);
  }
  run_storm(seed);
}

}  // namespace mars::storm
