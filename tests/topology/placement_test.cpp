// Where nodes go on made-up machines, alone and in clusters, and how close the cube's dimensions then are.
#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "topology/hypercube.h"
#include "topology/machine.h"
#include "topology/placement.h"

namespace mars::topology {
namespace {

// The seats of `n` nodes whose ids begin at `first_id` on machine number `machine`.
std::vector<Location> locations(const Machine& description, int machine, int n, int first_id) {
  std::vector<Location> nodes;
  for (int k = 0; k < n; ++k) nodes.push_back({machine, description.seat(*description.place(k, n, 0, first_id))});
  return nodes;
}

std::string text_of(const std::vector<Closeness>& dimensions) {
  constexpr std::array<const char*, 7> letters{"core", "L2", "L3", "numa", "package", "machine", "network"};
  std::string text;
  for (const Closeness closeness : dimensions)
    text.append(text.empty() ? "" : " ").append(letters[static_cast<std::size_t>(closeness)]);
  return text;
}

struct Known {
  const char* machine;
  int nodes;
  const char* dimensions;  // what the furthest neighbours share across dimension 0, 1 ...
};

// Machines as people have them; hwloc's words for them from their data sheets.
const Known kKnown[] = {
    {"pack:1 l3:1 l2:4 core:1 pu:2", 4, "L3 L3"},                      // a laptop
    {"pack:1 l3:2 l2:8 core:1 pu:2", 16, "L3 L3 L3 numa"},             // a desktop of two chiplets
    {"pack:1 l3:2 l2:8 core:1 pu:2", 2, "numa"},                       // its nodes have a chiplet each
    {"pack:1 l3:2 l2:8 core:1 pu:2", 6, "L3 L3 numa"},                 //
    {"l2:32 core:2 pu:4", 64, "L2 numa numa numa numa numa"},          // Xeon Phi: cores in pairs
    {"pack:2 numa:1 l3:1 l2:10 core:1 pu:2", 16, "L3 L3 L3 machine"},  // two Xeons
    {"pack:2 numa:1 l3:1 l2:10 core:1 pu:2", 20, "L3 machine machine machine machine"},     // ids 8 to 11 on both
    {"numa:4 l2:1 core:12 pu:1", 32, "L2 L2 L2 machine machine"},                           // A64FX: four groups
    {"pack:2 numa:4 l3:2 l2:8 core:1 pu:2", 128, "L3 L3 L3 numa package package machine"},  // EPYC, NPS4
    {"pack:2 numa:4 l3:2 l2:8 core:1 pu:2", 32, "L3 numa package package machine"},
    {"pack:1 numa:4 l3:2 l2:3 core:1 pu:2", 16, "L3 numa package package"},  // EPYC of chiplets of three cores
    {"numa:1 l3:1 l2:64 core:1 pu:1", 64, "L3 L3 L3 L3 L3 L3"},              // Graviton
    {"pu:4", 4, "numa numa"},                                                // a virtual machine
    {"pu:1", 1, ""},
};

TEST(Placement, LowDimensionsAreCloseOnKnownMachines) {
  for (const Known& known : kKnown) {
    const Machine machine = Machine::synthetic(known.machine);
    EXPECT_EQ(text_of(dimensions(locations(machine, 0, known.nodes, 0))), known.dimensions)
        << known.nodes << " nodes on " << known.machine;
  }
}

// On any machine and for any number of nodes, no dimension is further than a higher one.
TEST(Placement, NoDimensionIsFurtherThanAHigherOne) {
  for (const Known& known : kKnown) {
    const Machine machine = Machine::synthetic(known.machine);
    for (int n = 1; n <= machine.cores(); n *= 2) {
      const auto found = dimensions(locations(machine, 0, n, 0));
      EXPECT_TRUE(std::is_sorted(found.begin(), found.end())) << n << " nodes on " << known.machine;
    }
  }
}

// A machine whose ids begin at an odd number still has pairs together: 3 | 4 5 of two chiplets.
TEST(Placement, PlacesGoByIdsNotByCounts) {
  const Machine machine = Machine::synthetic("l3:2 core:2 pu:1");
  EXPECT_EQ(machine.place(0, 3, 0, 3), (Place{0, 2}));
  EXPECT_EQ(machine.place(1, 3, 0, 3), (Place{2, 1}));
  EXPECT_EQ(machine.place(2, 3, 0, 3), (Place{3, 1}));
}

TEST(Placement, ClosenessIsTheNearestThingShared) {
  const Machine machine = Machine::synthetic("pack:2 numa:2 l3:2 l2:2 core:2 pu:2");
  const auto at = [&](int core, int count = 1) { return Location{0, machine.seat({core, count})}; };
  EXPECT_EQ(closeness(at(5), at(5)), Closeness::core);
  EXPECT_EQ(closeness(at(4), at(5)), Closeness::l2);
  EXPECT_EQ(closeness(at(4), at(6)), Closeness::l3);
  EXPECT_EQ(closeness(at(0), at(4)), Closeness::numa);
  EXPECT_EQ(closeness(at(0), at(8)), Closeness::package);
  EXPECT_EQ(closeness(at(0), at(16)), Closeness::machine);
  EXPECT_EQ(closeness(at(0, 32), at(3)), Closeness::machine);  // bound to nothing
  EXPECT_EQ(closeness(at(0), {1, at(0).seat}), Closeness::network);
}

std::vector<Spot> cluster(const std::vector<int>& processes) {
  std::vector<Spot> spots;
  for (int machine = 0; machine < static_cast<int>(processes.size()); ++machine)
    for (int i = 0; i < processes[machine]; ++i) spots.push_back({machine, 0});
  return spots;
}

// Pairs across dimension `d` that lie on two machines.
int crossing(const std::vector<Spot>& spots, const std::vector<int>& ids, int d) {
  std::vector<int> machine_of(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) machine_of[ids[i]] = spots[i].machine;
  int pairs = 0;
  for (int id = 0; id < static_cast<int>(ids.size()); ++id) {
    const int other = neighbour(id, d);
    if (other > id && other < static_cast<int>(ids.size())) pairs += machine_of[id] != machine_of[other];
  }
  return pairs;
}

TEST(Numbering, EachIdIsGivenOnceAndMachinesKeepTheirsTogether) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<Spot> spots;
    for (unsigned i = 1 + random() % 40; i > 0; --i) spots.push_back({int(random() % 5), int(random() % 4)});
    const std::vector<int> ids = number_nodes(spots);
    std::vector<const Spot*> by_id(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) by_id.at(ids[i]) = &spots[i];
    ASSERT_EQ(std::count(by_id.begin(), by_id.end(), nullptr), 0);
    int changes = 0;
    for (std::size_t id = 1; id < by_id.size(); ++id) {
      changes += by_id[id]->machine != by_id[id - 1]->machine;
      if (by_id[id]->machine == by_id[id - 1]->machine) {
        ASSERT_LE(by_id[id - 1]->core, by_id[id]->core);
      }
    }
    ASSERT_LT(changes, 5);
  }
}

// The fewest pairs of dimension 0 cross that any numbering has: every machine's processes but the odd one
// find their neighbours at home.
TEST(Numbering, Dimension0CrossesAsSeldomAsCanBe) {
  std::mt19937 random(11);
  for (int round = 0; round < 500; ++round) {
    std::vector<int> counts(1 + random() % 7);
    for (int& count : counts) count = 1 + int(random() % 9);
    const auto spots = cluster(counts);
    int at_home = 0;
    for (const int count : counts) at_home += count / 2;
    EXPECT_EQ(crossing(spots, number_nodes(spots), 0), static_cast<int>(spots.size()) / 2 - at_home);
  }
}

// The host takes a processor of the first machine, so that its nodes are fewer: it comes last.
TEST(Numbering, AHostBesideTheNodesDoesNotShiftTheOthers) {
  const auto spots = cluster({3, 4, 4, 4});
  EXPECT_EQ(number_nodes(spots), (std::vector<int>{12, 13, 14, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(crossing(spots, number_nodes(spots), 0) + crossing(spots, number_nodes(spots), 1), 0);
  std::vector<int> in_order(spots.size());
  std::iota(in_order.begin(), in_order.end(), 0);
  EXPECT_GT(crossing(spots, in_order, 0), 0);
}

TEST(Numbering, RanksDealtRoundRobinComeHome) {
  std::vector<Spot> spots;
  for (int rank = 0; rank < 16; ++rank) spots.push_back({rank % 4, 0});
  const auto ids = number_nodes(spots);
  EXPECT_EQ(crossing(spots, ids, 0), 0);
  EXPECT_EQ(crossing(spots, ids, 1), 0);
  EXPECT_EQ(ids[4], 1);  // the second process of the first machine
}

// A cluster of four machines of two chiplets, 32 nodes: L3, L3, the machine, then the network.
TEST(Placement, MachinesAreTheHighestDimensions) {
  const Machine machine = Machine::synthetic("l3:2 core:4 pu:2");
  std::vector<Location> nodes;
  for (int i = 0; i < 4; ++i)
    for (const Location& location : locations(machine, i, 8, 8 * i)) nodes.push_back(location);
  EXPECT_EQ(text_of(dimensions(nodes)), "L3 L3 numa network network");
}

}  // namespace
}  // namespace mars::topology
