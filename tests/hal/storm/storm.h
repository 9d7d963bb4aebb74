// Random message storms. Every rank posts, sends, probes, asks, waits, cancels, flushes and masks at random, and holds
// what it sees against the rules: every message comes once and whole or is accounted for; messages of one sender
// stay in order; a message goes to the first posted receive that selects it. What is sent follows from the seed
// (plan.h), so each rank knows when all has come.
#pragma once

#include <cstdint>

namespace mars::storm {

// Every rank of a world calls it with the same seed. Throws a Failure that names seed and round.
void run_storm(std::uint32_t seed);

// Storms of the seeds that every run of the tests has.
void run_fixed_storms();

// One of the seed `wanted` of the host, or of one that it draws if that is 0; the host prints which.
void run_fresh_storm(std::uint32_t wanted);

}  // namespace mars::storm
