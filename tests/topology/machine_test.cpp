// Places on made-up machines, and binding on this one.
#include <sched.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "topology/machine.h"

namespace mars::topology {
namespace {

const char* const kMachines[] = {
    "pu:1",
    "core:4 pu:1",
    "core:6 pu:2",
    "numa:2 core:8 pu:2",
    "pack:2 numa:2 l3:2 core:3 pu:2",
    "pack:2 numa:4 l3:1 core:16 pu:1",
};

TEST(Machine, CountsWhatHwlocDescribes) {
  const Machine machine = Machine::synthetic("pack:2 numa:2 l3:2 core:3 pu:2");
  EXPECT_EQ(machine.cores(), 24);
  EXPECT_EQ(machine.processors(), 48);
  EXPECT_GT(machine.memory(), 0u);
}

TEST(Machine, WithoutCoresHasProcessors) {
  const Machine machine = Machine::synthetic("pu:4");
  EXPECT_EQ(machine.cores(), 4);
}

TEST(Machine, BadDescriptionIsNamed) {
  try {
    Machine::synthetic("core:nonsense");
    FAIL();
  } catch (const std::runtime_error& failure) {
    EXPECT_NE(std::string(failure.what()).find("core:nonsense"), std::string::npos);
  }
}

// Every process has cores of its own, in order, and what is left at the end is what was reserved.
TEST(Machine, PlacesAreDisjointInOrderAndLeaveTheReserve) {
  for (const char* description : kMachines) {
    const Machine machine = Machine::synthetic(description);
    for (int n = 1; n <= machine.cores(); ++n) {
      for (const int reserved : {0, 1, 3}) {
        int next = 0;
        for (int k = 0; k < n; ++k) {
          const auto place = machine.place(k, n, reserved);
          ASSERT_TRUE(place) << description;
          ASSERT_EQ(place->first, next);
          ASSERT_GE(place->count, 1);
          next += place->count;
        }
        ASSERT_EQ(next, machine.cores() - std::min(reserved, machine.cores() - n)) << description;
      }
    }
  }
}

TEST(Machine, ProcessesBeyondTheCoresHaveNoPlace) {
  const Machine machine = Machine::synthetic("core:4 pu:2");
  EXPECT_FALSE(machine.place(0, 5, 0));
  EXPECT_FALSE(machine.place(4, 4, 0));
  EXPECT_TRUE(machine.place(3, 4, 2));
}

TEST(Machine, HereIsWhatTheProcessMayUse) {
  cpu_set_t usable;
  ASSERT_EQ(sched_getaffinity(0, sizeof usable, &usable), 0);
  const Machine machine = Machine::here();
  EXPECT_EQ(machine.processors(), CPU_COUNT(&usable));
  EXPECT_GT(machine.memory(), 0u);
}

TEST(Machine, BindsThreadsToTheirPlaces) {
  const Machine machine = Machine::here();
  const int n = machine.cores();
  std::set<int> used;
  for (int k = 0; k < n; ++k) {
    std::jthread([&] {
      machine.bind_thread(*machine.place(k, n, 0));
      cpu_set_t mine;
      sched_getaffinity(0, sizeof mine, &mine);
      EXPECT_EQ(CPU_COUNT(&mine), machine.processors() / n);
      used.insert(sched_getcpu());
      EXPECT_EQ(Machine::here().cores(), 1);  // a bound thread sees only its own
      if (n > 1) {
        EXPECT_EQ(Machine::binding().cores.substr(0, 5), "core ");
      }
    }).join();
  }
  EXPECT_EQ(static_cast<int>(used.size()), n);
  EXPECT_EQ(Machine::here().cores(), n);
}

TEST(Machine, BindingIsReported) {
  const std::string before = Machine::binding().cores;
  const Machine machine = Machine::here();
  if (machine.cores() < 2 || !before.empty()) GTEST_SKIP() << "needs a machine of its own with two cores";
  std::jthread([&] {
    machine.bind_thread({1, 1});
    EXPECT_EQ(Machine::binding().cores, "core 1");
    EXPECT_EQ(Machine::binding().first_core, 1);
    EXPECT_EQ(Machine::binding().seat, machine.seat({1, 1}));
    machine.bind_thread({0, machine.cores()});
    EXPECT_EQ(Machine::binding().cores, "");
  }).join();
}

TEST(Machine, BindingToSomeCoresIsReported) {
  const Machine machine = Machine::here();
  if (machine.cores() < 3 || !Machine::binding().cores.empty())
    GTEST_SKIP() << "needs a machine of its own with three cores";
  std::jthread([&] {
    machine.bind_thread({0, 2});
    EXPECT_EQ(Machine::binding().cores, "cores 0-1");
  }).join();
}

TEST(Machine, BindingBeyondTheCoresIsAFailure) {
  const Machine machine = Machine::here();
  EXPECT_THROW(machine.bind_thread({machine.cores(), 1}), std::runtime_error);
}

}  // namespace
}  // namespace mars::topology
