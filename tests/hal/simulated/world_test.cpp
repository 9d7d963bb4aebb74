// The simulated job: who runs when, what waits cost, how it ends.
#include "hal/simulated/world.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "hal/simulated/run_simulated.h"

namespace mars::simulated {
namespace {

constexpr double kByte = 1e-6, kLatency = 1e-3, kSend = 2e-3, kReceive = 4e-3;
constexpr int kKind = 0;  // of work: a second a unit

Machine machine() {
  Machine machine{.host_apart = true, .work = {1.0}};
  machine.network = {.latency = kLatency, .byte = kByte};
  machine.network.send = {{0, kSend}};
  machine.network.receive = {{0, kReceive}};
  return machine;
}

void nothing(World&) {}

TEST(World, AMessageTakesItsEndsAndItsWay) {
  double came = 0;
  run_simulated(machine(), 2, nothing, [&] {
    std::vector<char> data(1000);
    if (mynode() == 0) return csend(1, data.data(), 1000, 1, 0);
    crecv(1, data.data(), 1000);
    came = dclock();
  });
  EXPECT_DOUBLE_EQ(came, kSend + kLatency + 1000 * kByte + kReceive);
}

TEST(World, MessagesAreTakenInTheOrderOfSimulatedTime) {
  std::vector<long> order;
  const auto host = [&](World& world) {
    for (int i = 0; i < world.nodes(); ++i) {
      crecv(1, nullptr, 0);
      order.push_back(infonode());
    }
  };
  run_simulated(machine(), 4, host, [] {
    messages::charge(kKind, static_cast<std::uint64_t>(10 - mynode()));
    csend(1, nullptr, 0, myhost(), 0);
  });
  EXPECT_EQ(order, (std::vector<long>{3, 2, 1, 0}));
}

TEST(World, ItsEndIsThatOfTheLastRank) {
  EXPECT_DOUBLE_EQ(
      run_simulated(machine(), 3, nothing, [] { messages::charge(kKind, static_cast<std::uint64_t>(mynode())); }), 2);
}

TEST(World, RanksOfAComputerShareItsProcessors) {
  Machine crowded = machine();
  crowded.nodes = 4;
  const auto work = [] { messages::charge(kKind, 6); };
  for (const auto& [processors, end] : {std::pair{1, 24.0}, {2, 12.0}, {4, 6.0}}) {
    crowded.processors = processors;
    EXPECT_DOUBLE_EQ(run_simulated(crowded, 4, nothing, work), end) << processors;
  }
}

TEST(World, WorkOfNoRankIsDoneByFreeProcessorsAndWakesTheHost) {
  Machine with_two = machine();
  with_two.host_processors = 2;
  double woken = 0;
  const auto host = [&](World& world) {
    EXPECT_DOUBLE_EQ(world.reserve(1, 3), 3);
    EXPECT_DOUBLE_EQ(world.reserve(1, 3), 3) << "on the other processor";
    const double end = world.reserve(1, 3);
    EXPECT_DOUBLE_EQ(end, 6);
    world.set_alarm(1, end);
    world.wait(1, World::kNever);
    woken = dclock();
  };
  run_simulated(with_two, 1, host, [] {});
  EXPECT_DOUBLE_EQ(woken, 6);
}

TEST(World, StorageTakesFilesOneAfterAnotherNoFasterThanTheirPorts) {
  Machine with_storage = machine();
  with_storage.network.byte = 0.5;
  with_storage.storage = {.opening = 1, .byte = 0.25};
  std::vector<double> there;
  const auto host = [&](World& world) { there = {world.store(1, 0, 4), world.store(1, 0, 4), world.store(1, 10, 4)}; };
  run_simulated(with_storage, 1, host, [] {});
  EXPECT_EQ(there, (std::vector<double>{3, 4, 13}));
}

std::string failure_of(int nodes, const std::function<void()>& node) {
  try {
    run_simulated(machine(), nodes, nothing, node);
  } catch (const Failure& failure) {
    return failure.problem;
  }
  return "";
}

TEST(World, AStandstillIsFound) {
  EXPECT_EQ(failure_of(3, [] { crecv(1, nullptr, 0); }), "all ranks wait, and no message is on its way");
}

TEST(World, AFailureEndsAllRanks) {
  int ended = 0;
  const auto node = [&] {
    const struct Count {
      int& count;
      ~Count() { ++count; }
    } count{ended};
    if (mynode() == 1) throw Failure("node 1 is tired", "", "");
    crecv(1, nullptr, 0);
  };
  EXPECT_EQ(failure_of(3, node), "node 1 is tired");
  EXPECT_EQ(ended, 2) << "the last had not begun";
}

// Two groups of four, each of which passes a message around after work, and tells the host.
std::vector<double> times_of_groups(bool keep) {
  std::vector<double> times;
  const auto host = [&](World& world) {
    for (int i = 0; i < world.nodes(); ++i) {
      crecv(1, nullptr, 0);
      times.push_back(dclock());
      times.push_back(static_cast<double>(infonode()));
    }
  };
  times.push_back(run_simulated(machine(), 8, host, [keep] {
    const long self = mynode(), first = self / 4 * 4;
    if (keep) messages::keep_to(static_cast<int>(first), 4);
    messages::charge(kKind, static_cast<std::uint64_t>(1 + self * 7 % 5));
    csend(2, nullptr, 0, first + (self + 1) % 4, 0);
    crecv(2, nullptr, 0);
    csend(1, nullptr, 0, myhost(), 0);
  }));
  return times;
}

TEST(World, EveryRunGivesTheSameTimes) { EXPECT_EQ(times_of_groups(true), times_of_groups(true)); }

TEST(World, GroupsThatRunAheadChangeNoTime) { EXPECT_EQ(times_of_groups(true), times_of_groups(false)); }

TEST(World, WhoWaitsForAnybodyDoesNotRunAhead) {
  double heard = 0;
  const auto host = [](World& world) {
    world.work(world.nodes(), 1);
    csend(2, nullptr, 0, 1, 0);
  };
  run_simulated(machine(), 4, host, [&] {
    if (mynode() == 0) {
      messages::keep_to(0, 2);
      messages::charge(kKind, 5);
      csend(1, nullptr, 0, 1, 0);
    } else if (mynode() == 1) {
      crecv(2, nullptr, 0);
      heard = dclock();
      crecv(1, nullptr, 0);
    }
  });
  EXPECT_DOUBLE_EQ(heard, 1 + kSend + kLatency + kReceive);
}

// Node 1 is of the group of node 0, but has not come to know it: both send to node 2.
TEST(World, AGroupWaitsForItsRanksThatHaveYetToJoin) {
  std::vector<long> senders;
  constexpr long kLong = 2'000'000;  // two seconds on the way
  run_simulated(machine(), 4, nothing, [&] {
    const long self = mynode();
    std::vector<char> bytes(kLong);
    if (self == 0) messages::keep_to(0, 3);
    if (self < 2) {
      messages::charge(kKind, self == 0 ? 2 : 1);
      csend(1, bytes.data(), kLong, 2, 0);
    }
    for (int i = 0; self == 2 && i < 2; ++i) {
      crecv(1, bytes.data(), kLong);
      senders.push_back(infonode());
    }
  });
  EXPECT_EQ(senders, (std::vector<long>{1, 0})) << "who sends first has the port first";
}

TEST(World, AGroupRunsAheadUntilAllItsRanksWait) {
  std::vector<long> order;
  run_simulated(machine(), 4, nothing, [&] {
    const long self = mynode();
    messages::keep_to(static_cast<int>(self / 2 * 2), 2);
    for (int round = 0; round < 2; ++round) {
      messages::charge(kKind, 1);
      csend(1, nullptr, 0, self ^ 1, 0);
      crecv(1, nullptr, 0);
    }
    order.push_back(self);
  });
  EXPECT_EQ(order, (std::vector<long>{0, 1, 2, 3})) << "in real order: the first group is done before the second";
}

}  // namespace
}  // namespace mars::simulated
