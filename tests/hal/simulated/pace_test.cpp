// Work on computers that differ, against times worked out by hand, and what the seed draws.
#include "hal/simulated/pace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

#include "hal/simulated/computers.h"

namespace mars::simulated {
namespace {

constexpr int kMany = 10000;  // computers

std::vector<double> ends(const Machine& machine, int computers, double seconds) {
  const Pace pace(machine, computers);
  std::vector<double> all;
  for (int computer = 0; computer < computers; ++computer) all.push_back(pace.end({computer, 0}, 10, seconds) - 10);
  return all;
}

Machine noisy(std::uint32_t seed, Lengths lengths) {
  return {.noise = {.seed = seed, .detours = 100, .detour = 1e-3, .lengths = lengths}};
}

// When work that begins at 0 ends, on a computer of a noisy machine.
double end_on_noisy(std::uint32_t seed, Lengths lengths, double seconds, Pace::Processor processor = {0, 0},
                    int computers = 1) {
  const Machine machine = noisy(seed, lengths);
  return Pace(machine, computers).end(processor, 0, seconds);
}

static_assert(!std::is_constructible_v<Pace, Machine, int> && std::is_constructible_v<Pace, Machine&, int>,
              "it keeps a reference");

TEST(Pace, IsEvenWhereNothingIsGiven) {
  const Machine even;
  EXPECT_FALSE(even.is_uneven());
  EXPECT_EQ(Pace(even, 2).end({1, 0}, 0.1, 0.2), 0.1 + 0.2) << "to the last digit";
}

TEST(Pace, KindsOfComputersTakeTurns) {
  const Machine machine{.host_speed = 4, .speeds = {{2, 1}, {1, 0.5}}};
  EXPECT_EQ(ends(machine, 7, 2), (std::vector<double>{2, 2, 4, 2, 2, 4, 2}));
  EXPECT_DOUBLE_EQ(Pace(machine, 7).end({7, 0}, 0, 2), 0.5) << "the host's";
  EXPECT_TRUE(machine.is_uneven());
}

TEST(Pace, StragglersAreThePartThatIsGiven) {
  const auto straggling = [](std::uint32_t seed) {
    return ends({.noise = {.seed = seed, .stragglers = 0.1, .least_slowdown = 1.5, .most_slowdown = 2}}, kMany, 1);
  };
  const std::vector<double> drawn = straggling(1);
  const auto slow = std::ranges::count_if(drawn, [](double seconds) { return seconds > 1; });
  EXPECT_NEAR(static_cast<double>(slow) / kMany, 0.1, 0.01);
  EXPECT_TRUE(std::ranges::all_of(drawn, [](double s) { return s == 1 || (s >= 1.5 && s <= 2 + 1e-9); }));
  EXPECT_GT(std::ranges::max(drawn), 1.95) << "all slownesses are as likely";
  EXPECT_EQ(drawn, straggling(1));
  EXPECT_NE(drawn, straggling(2));
}

// Each by itself would take for ever.
TEST(Pace, VeryManyDetoursTakeTheirMean) { EXPECT_DOUBLE_EQ(end_on_noisy(1, Lengths::exponential, 1e9), 1e9 / 0.9); }

// Work of 10 s ends once it has got them: a tenth of the time is the system's.
TEST(Pace, DetoursLengthenWorkByTheirPart) {
  for (const Lengths lengths : {Lengths::fixed, Lengths::exponential}) {
    const Machine machine = noisy(1, lengths);
    const Pace pace(machine, 4);
    for (const int computer : {0, 3}) EXPECT_NEAR(pace.end({computer, 0}, 5, 10), 5 + 10 / 0.9, 0.2);
  }
}

TEST(Pace, FixedDetoursAreAllAsLong) {
  const double spent = end_on_noisy(1, Lengths::fixed, 1) - 1;
  EXPECT_NEAR(spent / 1e-3, std::round(spent / 1e-3), 1e-6);
  const double exponential = end_on_noisy(1, Lengths::exponential, 1) - 1;
  EXPECT_GT(std::abs(exponential / 1e-3 - std::round(exponential / 1e-3)), 1e-3);
}

TEST(Pace, PiecesOfWorkEndWhenTheWholeDoes) {
  const Machine machine = noisy(3, Lengths::exponential);
  const Pace pace(machine, 1);
  double end = 2;
  for (int piece = 0; piece < 1000; ++piece) end = pace.end({0, 0}, end, 1e-3);
  EXPECT_NEAR(end, pace.end({0, 0}, 2, 1), 1e-9);
}

TEST(Pace, DetoursOfSeedsComputersAndProcessorsDiffer) {
  const auto end = [](std::uint32_t seed, Pace::Processor processor) {
    return end_on_noisy(seed, Lengths::exponential, 1, processor, 2);
  };
  EXPECT_EQ(end(1, {0, 0}), end(1, {0, 0}));
  for (const auto& [seed, processor] : {std::pair{2u, Pace::Processor{0, 0}}, {1u, {1, 0}}, {1u, {0, 1}}})
    EXPECT_NE(end(1, {0, 0}), end(seed, processor));
}

TEST(Computers, RanksHaveProcessorsOfTheirOwn) {
  Machine machine = noisy(1, Lengths::exponential);
  machine.nodes = machine.processors = 2;
  machine.host_apart = true;
  Computers computers(machine, 4);
  EXPECT_FALSE(computers.any_crowded());
  const Pace pace(machine, 2);
  for (int rank = 0; rank < 4; ++rank)
    EXPECT_EQ(computers.work(rank, 0, 1), pace.end({rank / 2, rank % 2}, 0, 1)) << rank;
  EXPECT_EQ(computers.work(4, 0, 1), pace.end({2, 0}, 0, 1)) << "the host";
}

}  // namespace
}  // namespace mars::simulated
