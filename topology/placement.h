// The placement of nodes on machines. A cube's exchanges go across dimension 0, 1, 2 ..., so nodes whose ids differ in
// a low bit shall share as much of a machine as can be: ids are given out machine by machine (number_nodes), on a
// machine Machine::place goes by the same bits, and dimensions() reports the result. Pure numbers, except that seats
// come from Machine.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace mars::topology {

// The parts of a machine that two processes may share, from near to far.
enum class Part : std::uint8_t { core, l2, l3, numa, package };
inline constexpr int kParts = 5;

// By Part, the part (hwloc's logical number) that holds all processors that a process may use; -1 where there is none
// or it uses several.
using Seat = std::array<std::int32_t, kParts>;

// The nearest thing that two processes share: a Part, the machine, or only the network.
enum class Closeness : std::uint8_t { core, l2, l3, numa, package, machine, network };

// "a core", "an L2 cache", ... "the network".
std::string_view text_of(Closeness closeness);

// A node's machine, by any number of its own, and its seat there.
struct Location {
  std::int32_t machine = 0;
  Seat seat{};
};

Closeness closeness(const Location& a, const Location& b);

// The closeness of the furthest neighbours across dimension 0, 1, 2 ... of the hypercube of `nodes`, by id.
std::vector<Closeness> dimensions(std::span<const Location> nodes);

// Where a process runs before it has a node id.
struct Spot {
  int machine = 0;  // any number of its own
  int core = 0;     // the first that it may use
};

// The node id of each process: a machine's processes have successive ids, in order of their cores. Machines
// with an even number come first, most even ones before, so that as many pairs across the low dimensions as
// can be are on one machine; else the order of machines and processes stays.
std::vector<int> number_nodes(std::span<const Spot> processes);

}  // namespace mars::topology
