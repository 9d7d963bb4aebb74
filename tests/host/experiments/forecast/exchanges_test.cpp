// Exchanges of a group, played through: every node comes to its end, and bytes are those of the pattern.
#include "host/experiments/forecast/exchanges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace mars::forecast {
namespace {

constexpr double kByte = 1e-6, kLatency = 1e-3;

// Computers of one node on a switch; work and ends of messages cost nothing.
class Played {
 public:
  explicit Played(const Exchange& exchange) : nodes_(static_cast<int>(exchange.size())) {
    platform_.machine.host_apart = true;
    platform_.machine.network = {.latency = kLatency, .byte = kByte};
    Clockwork clockwork;
    simulated::Computers computers(platform_.machine, nodes_);
    simulated::Routes routes(platform_.machine.network, computers.count(), computers.count());
    const Costs costs(platform_);
    Exchanges exchanges(clockwork, computers, routes, costs, nodes_);
    for (int node = 0; node < nodes_; ++node)
      exchanges.begin(node, 0, exchange[static_cast<std::size_t>(node)], [&] { ended.push_back(clockwork.now()); });
    clockwork.run(1e9);
    bytes = exchanges.bytes();
  }

  bool all_ended() const { return static_cast<int>(ended.size()) == nodes_; }

  std::vector<double> ended;
  double bytes = 0;

 private:
  const int nodes_;
  experiments::Platform platform_;
};

Machines machines(int nodes, int near, const std::vector<int>& drawing) {
  std::vector<std::uint8_t> draws(static_cast<std::size_t>(nodes));
  for (const int node : drawing) draws[static_cast<std::size_t>(node)] = 1;
  return Machines(0, near, draws);
}

TEST(Exchanges, ASumCrossesEachDimension) {
  for (const int nodes : {2, 3, 4, 7, 8, 64}) EXPECT_TRUE(Played(sum_steps(nodes, 800)).all_ended()) << nodes;
  const Played eight(sum_steps(8, 800));
  EXPECT_EQ(eight.bytes, 8 * 3 * 800);
  EXPECT_NEAR(eight.ended.back(), 3 * (kLatency + 800 * kByte), 1e-9);
  EXPECT_EQ(Played(sum_steps(8, 800000)).bytes, 8 * 2 * (400000 + 200000 + 100000)) << "long ones are halved";
}

TEST(Exchanges, MessagesToOneNodeWaitForEachOther) {
  const std::vector<std::vector<Parcel>> parcels{{}, {{0, 10, 5}}, {{0, 10, 5}}, {{0, 10, 5}}};
  const Played played(triangle_steps(parcels, 0));
  EXPECT_TRUE(played.all_ended());
  EXPECT_EQ(played.bytes, 3 * (64 + 128 + 5 * 64));
  EXPECT_NEAR(std::ranges::max(played.ended), kLatency + played.bytes * kByte, 1e-9);
}

TEST(Exchanges, LinesGoToEachMachineThatDrawsInbetweens) {
  const std::vector<std::vector<double>> lines(6, {1000, 500});
  EXPECT_EQ(Played(still_steps(machines(6, 1, {0, 1, 2, 3, 4, 5}), lines)).bytes, 6 * 5 * 1500);
  EXPECT_EQ(Played(still_steps(machines(6, 2, {0, 1, 2, 3, 4, 5}), lines)).bytes, 6 * 2 * 1500);
  EXPECT_EQ(Played(still_steps(machines(6, 1, {2}), lines)).bytes, 5 * 1500);
}

// Its port is the owner's once, not five times.
TEST(Exchanges, EachMachineReceivesLinesOnceAndPassesThemOn) {
  const std::vector<std::vector<double>> lines(6, {1000, 500});
  for (const int near : {1, 2, 3})
    for (const std::vector<int>& drawing : {std::vector<int>{0, 1, 2, 3, 4, 5}, {1}, {0, 5}, {2, 3}})
      EXPECT_TRUE(Played(still_steps(machines(6, near, drawing), lines)).all_ended());
  const std::vector<std::vector<double>> of_one{std::vector<double>(20, 1000), {}, {}, {}, {}, {}};
  const Played played(still_steps(machines(6, 1, {0, 1, 2, 3, 4, 5}), of_one));
  EXPECT_EQ(played.bytes, 5 * 20000);
  EXPECT_LT(std::ranges::max(played.ended), 2 * 20000 * kByte + 5 * (kLatency + 1000 * kByte));
}

// A ring without time is a meeting: all wait for the last, with few messages.
TEST(Exchanges, LinesThatTakeNoTimeKeepNodesTogether) {
  constexpr int kNodes = 300;
  std::vector<int> all(kNodes);
  std::iota(all.begin(), all.end(), 0);
  const std::vector<std::vector<double>> lines(kNodes, {1500, 1500});
  for (const Relayed relayed : {Relayed::at_once, Relayed::in_time}) {
    Exchange exchange = still_steps(machines(kNodes, 1, all), lines, relayed);
    exchange[7].insert(exchange[7].begin(), work(5));
    const Played played(exchange);
    EXPECT_TRUE(played.all_ended());
    EXPECT_GE(std::ranges::min(played.ended), 5);
  }
  EXPECT_TRUE(Played(still_steps(machines(kNodes, 1, {0, 1}), lines, Relayed::at_once)).all_ended());
}

TEST(Exchanges, BandsGoToTheWriterAndToWhoDrawsInbetweens) {
  std::vector<NodeBands> bands(4, {0, -1, true, 100, 0.5, {300}});
  bands[1].edge = 50, bands[1].composer = 0;
  const Played played(band_steps(machines(4, 1, {0, 1}), bands, 2));
  EXPECT_TRUE(played.all_ended());
  EXPECT_EQ(played.bytes, 50 + (3 + 3) * 300 + 3 * 100);
}

}  // namespace
}  // namespace mars::forecast
