// A machine room to be simulated: computers with nodes of the job on them, the network between them, and what work
// costs there. Times are in seconds, rates in seconds a byte.
#pragma once

#include <cstddef>
#include <functional>
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
  // Messages of such a type take no time; none: all do.
  std::function<bool(int type)> is_free{};

  bool takes_time(int type) const { return !is_free || !is_free(type); }
};

// File storage that all computers share: it opens one file after another, and takes their bytes one after another.
struct Storage {
  double opening = 0;  // of a file
  double byte = 0;
};

struct Machine {
  int nodes = 1;               // of the job on a computer, the last has the rest
  int processors = 1;          // of a computer
  bool host_apart = false;     // the host has a computer of its own; else it is on the first node's
  int host_processors = 1;     // of that
  std::vector<double> work{};  // by kind, seconds a unit (Backend::charge)
  // How many times as long work takes on a computer that begins it at a time; none: all are as fast.
  std::function<double(int computer, double now)> slowness{};
  Network network{};
  Storage storage{};
};

}  // namespace mars::simulated
