// When messages arrive, against times worked out by hand.
#include "hal/simulated/routes.h"

#include <gtest/gtest.h>

namespace mars::simulated {
namespace {

constexpr double kRouteByte = 1e-3, kRouteLatency = 0.25, kHop = 0.5;
constexpr std::size_t kLong = 4000;  // bytes: 4 s

Network network_of(Topology topology) {
  Network network{.topology = topology, .latency = kRouteLatency, .hop = kHop, .byte = kRouteByte};
  network.leaf = 2;
  network.uplink = 2 * kRouteByte;
  network.local_latency = 0.125;
  network.local_byte = kRouteByte / 2;
  return network;
}

// Of 8 computers, with the host on one more.
struct Net : Routes {
  explicit Net(Topology topology) : Routes(network_of(topology), 8, 8) {}
  double arrival(int from, int to, std::size_t bytes, double time) { return Routes::arrival(from, to, bytes, time, 0); }
};

constexpr double kTwoPorts = kRouteLatency + 2 * kHop;

TEST(OneSwitch, TakesLatencyPortsAndBytesOnce) {
  Net net(Topology::one_switch);
  EXPECT_DOUBLE_EQ(net.arrival(0, 1, 0, 10), 10 + kTwoPorts);
  EXPECT_DOUBLE_EQ(net.arrival(0, 1, kLong, 10), 10 + 4 + kTwoPorts);
  EXPECT_DOUBLE_EQ(net.arrival(3, 3, kLong, 10), 10 + 2 + 0.125) << "within a computer";
}

TEST(OneSwitch, TwoThatSendToOneShareItsPort) {
  Net net(Topology::one_switch);
  EXPECT_DOUBLE_EQ(net.arrival(0, 2, kLong, 0), 4 + kTwoPorts);
  EXPECT_DOUBLE_EQ(net.arrival(1, 2, kLong, 0), 8 + kTwoPorts);
  EXPECT_DOUBLE_EQ(net.arrival(3, 4, kLong, 0), 4 + kTwoPorts) << "others do not wait";
}

TEST(OneSwitch, MessagesOfAPairKeepTheirOrder) {
  Net net(Topology::one_switch);
  const double first = net.arrival(0, 1, kLong, 0);
  EXPECT_GE(net.arrival(0, 1, 0, 0), first);
  EXPECT_GE(net.arrival(0, 1, 1, 1), first);
}

TEST(OneSwitch, WhatIsGivenLaterTakesAFreeStretch) {
  Net net(Topology::one_switch);
  net.arrival(0, 2, kLong, 10);
  EXPECT_DOUBLE_EQ(net.arrival(1, 2, kLong, 2), 6 + kTwoPorts) << "before it";
  EXPECT_DOUBLE_EQ(net.arrival(3, 2, kLong, 7), 10 + 4 + 4 + kTwoPorts) << "only behind it are 4 s free";
}

TEST(FatTree, LeavesShareTheirUplink) {
  Net net(Topology::fat_tree);
  const double four_parts = kRouteLatency + 4 * kHop;
  EXPECT_DOUBLE_EQ(net.arrival(0, 1, kLong, 0), 4 + kTwoPorts) << "within a leaf";
  EXPECT_DOUBLE_EQ(net.arrival(4, 6, kLong, 0), 8 + four_parts);
  EXPECT_DOUBLE_EQ(net.arrival(5, 2, kLong, 0), 16 + four_parts) << "from the same leaf";
}

TEST(Dragonfly, EachPairOfGroupsHasALink) {
  Net net(Topology::dragonfly);
  const double three_parts = kRouteLatency + 3 * kHop;
  EXPECT_DOUBLE_EQ(net.arrival(0, 2, kLong, 0), 8 + three_parts);
  EXPECT_DOUBLE_EQ(net.arrival(1, 4, kLong, 0), 8 + three_parts) << "another pair";
  EXPECT_DOUBLE_EQ(net.arrival(1, 3, kLong, 4), 16 + three_parts) << "the same";
}

TEST(Hypercube, TakesEcubeRoutesAndHoldsAllTheirChannels) {
  Net net(Topology::hypercube);
  EXPECT_DOUBLE_EQ(net.arrival(0, 7, kLong, 0), 4 + kRouteLatency + 3 * kHop);
  EXPECT_DOUBLE_EQ(net.arrival(1, 3, kLong, 0), 8 + kRouteLatency + kHop) << "0 to 7 goes over 1, 3";
  EXPECT_DOUBLE_EQ(net.arrival(0, 2, kLong, 0), 4 + kRouteLatency + kHop) << "but not over 2";
  EXPECT_DOUBLE_EQ(net.arrival(3, 1, kLong, 0), 4 + kRouteLatency + kHop) << "nor back";
}

TEST(Hypercube, TheHostIsBesideComputer0) {
  Network network = network_of(Topology::hypercube);
  network.host_byte = 3 * kRouteByte;
  network.host_latency = 7;
  Routes net(network, 8, 8);
  EXPECT_DOUBLE_EQ(net.arrival(8, 0, kLong, 0, 0), 12 + 7 + kRouteLatency + kHop);
  EXPECT_DOUBLE_EQ(net.arrival(3, 8, kLong, 0, 0), 12 + 7 + kRouteLatency + 3 * kHop) << "at the rate of the slowest";
}

TEST(AnyNetwork, TheHostMayHaveAPortOfItsOwnRate) {
  Network network = network_of(Topology::one_switch);
  network.host_byte = kRouteByte / 4;
  Routes net(network, 8, 8);
  EXPECT_DOUBLE_EQ(net.arrival(0, 8, kLong, 0, 0), 4 + kTwoPorts) << "the sender's is slower";
  EXPECT_DOUBLE_EQ(net.arrival(1, 8, kLong, 0, 0), 4 + kTwoPorts);
}

}  // namespace
}  // namespace mars::simulated
