// A machine room to be simulated: computers with nodes of the job on them, the network between them, and what work
// costs there. Times are in seconds, rates in seconds a byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace mars::simulated {

// What a message costs the processor at one of its ends, by its length.
struct EndCost {
  std::size_t from = 0;  // bytes: of messages as long as this or longer
  double seconds = 0;
};

enum class Topology {
  one_switch,  // each computer has one port of a switch that is never short of rate
  hypercube,   // e-cube routes; a message holds all channels of its way at once
  fat_tree,    // switches of `leaf` computers; `uplink` may be slower than the leaf's ports together
  dragonfly,   // all groups of `leaf` computers are joined in pairs, by one link of `uplink` each
};

struct Network {
  Topology topology = Topology::one_switch;
  double latency = 0;        // from end to end
  double hop = 0;            // for each switch or channel on the way
  double byte = 0;           // of a port or channel
  double uplink = 0;         // seconds a byte, of a leaf's or a pair's links together
  int leaf = 0;              // computers
  double local_latency = 0;  // between ranks of one computer
  double local_byte = 0;
  double host_latency = 0;                 // beside the hypercube's node 0; else the host has a port like others
  double host_byte = 0;                    // of its link, or of its port where that is not as the others
  double copy_byte = 0;                    // of the processor, at each end
  std::vector<EndCost> send{}, receive{};  // ascending
  std::vector<EndCost> host_end{};         // of the host, whether it sends or receives; empty: as the nodes'
  // Bytes: longer messages between computers wait until their receiver has answered an announcement (routes.h).
  std::size_t eager = std::numeric_limits<std::size_t>::max();
  // Messages of such a type take no time; none: all do.
  std::function<bool(int type)> is_free{};

  bool takes_time(int type) const { return !is_free || !is_free(type); }
};

// File storage that all computers share: one server opens files, one after another; others take their bytes, each one
// file after another.
struct Storage {
  double opening = 0;      // of a file
  double byte = 0;         // of a server
  int servers = 1;         // that take bytes
  double stripe = 0;       // bytes of a file on a server, the next are on the next server; 0: a file is on one
  double writer_byte = 0;  // of a computer that writes
};

// A number of computers of one speed.
struct SpeedKind {
  int computers = 1;
  double speed = 1;  // 2: work takes half as long
};

enum class Lengths { fixed, exponential };

// What makes computers slower than they should be, drawn from a seed (pace.h).
struct Noise {
  std::uint32_t seed = 0;
  double stragglers = 0;                         // the part of the nodes' computers that are slow all the time
  double least_slowdown = 1, most_slowdown = 1;  // how many times as long work takes there, all as likely
  double detours = 0;                            // a second: the system takes a processor, each at moments of its own
  double detour = 0;                             // seconds, in the mean
  Lengths lengths = Lengths::fixed;              // of detours
};

struct Machine {
  int nodes = 1;            // of the job on a computer, the last has the rest
  int processors = 1;       // of a computer
  bool host_apart = false;  // the host has a computer of its own; else it is on the first node's
  int host_processors = 1;  // of that
  double host_speed = 1;    // of that
  // Of the nodes' computers, in turn: after the last kind comes the first again. None: all have speed 1.
  std::vector<SpeedKind> speeds{};
  Noise noise{};
  std::vector<double> work{};  // by kind, seconds a unit (Backend::charge)
  // How many times as long again work takes on a computer that begins it at a time; none: no longer.
  std::function<double(int computer, double now)> slowness{};
  Network network{};
  Storage storage{};

  // Whether some of the nodes' computers are slower than others, for a while or always.
  bool is_uneven() const { return !speeds.empty() || noise.stragglers > 0 || noise.detours > 0 || slowness; }
};

}  // namespace mars::simulated
