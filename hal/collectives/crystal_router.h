// Sparse all-to-all: each node of a group has messages for some others, which do not know of them. The crystal
// router (Fox et al., Solving Problems on Concurrent Processors, 1988) sends log2 P messages a node, one
// across each dimension, which carry all that has to cross it; sending to each node directly takes P - 1.
// Positions that are not corners (dimension_exchange.h) hand theirs to their corner and get theirs from it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hal/collectives/group.h"
#include "hal/messages/backend.h"

namespace mars::collectives {

// Bytes for a node, or from one; ids.
struct Parcel {
  int node;
  std::span<const std::byte> bytes;
};

enum class Route {
  automatic,  // by the number of nodes and the most bytes that one of them sends, on which they agree first:
              // route_for
  crystal,
  direct,
  network,  // the network's own all-to-all, where the backend has one and the group is the whole machine;
            // else direct
};

// The quicker one for so many nodes of which none sends more than `bytes`, heads included: docs/messages.md
// has the measurements.
Route route_for(int nodes, std::size_t bytes);

// Its buffers are used again by the next exchange.
class CrystalRouter {
 public:
  // All members of the group call, with the same route; parcels may be for the node itself, and several for
  // one node. Returns what is for this node, by sender, and of each sender in the order given: valid until
  // the next exchange.
  std::span<const Parcel> exchange(const Group& group, std::span<const Parcel> parcels, Route route = Route::automatic);

 private:
  // Records one behind the other: each a head and its bytes.
  struct Load {
    std::vector<std::byte> buffer;
    std::size_t size = 0;
  };
  struct Head;

  template <class Visit>
  static void visit(const Load& load, const Visit& visit);
  static void add(Load& load, const Head& head, const std::byte* bytes);
  template <class Wanted>
  static void split(const Load& from, Load& wanted, Load& others, const Wanted& is_wanted);
  static void send(int to, const Load& load);
  static messages::Ticket start(int to, const Load& load);
  static void receive(int from, Load& load);

  void by_crystal(const Group& group);
  void directly(const Group& group);
  bool by_network(const Group& group);
  std::span<const Parcel> sorted();

  Load held_, next_, out_;
  std::vector<Load> loads_;  // by position
  std::vector<messages::ByteRange> to_, from_;
  std::vector<std::size_t> lengths_;
  std::vector<messages::Ticket> tickets_;
  std::vector<Parcel> parcels_;
};

}  // namespace mars::collectives
