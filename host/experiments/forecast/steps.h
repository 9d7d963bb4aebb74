// What the nodes of a group send each other in a keyframe, as steps that each of them takes one after the other. Here
// are the patterns of all exchanges, as node/group and hal/collectives have them; exchanges.h plays them through.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mars::forecast {

// As nodes have them in memory and send them (node/geometry/triangle.h, node/raster/edge_box.h).
inline constexpr std::uint64_t kTriangleBytes = 64, kUnsortedBoxBytes = 12, kBoxBytes = 8;

// Nodes are numbered within their group.
struct Step {
  enum class Kind : std::uint8_t { work, send, receive };

  Kind kind;
  std::uint8_t label;   // of messages: which receive they are for
  std::int32_t node;    // send: to it. receive: to whom messages go on that have way to go
  std::uint32_t count;  // receive: how many. send: how often receivers pass it on
  double bytes;         // send
  double seconds;       // work: of the node. send: of the receiver, beside receiving
};

using Steps = std::vector<Step>;
using Exchange = std::vector<Steps>;  // by node

// Of messages with such a label, as nodes send them (wire/protocol.h; message_types.h of collectives).
long message_type(std::uint8_t label);

Step work(double seconds);
Step send(std::uint8_t label, int to, double bytes, double seconds = 0);
// `next`: to whom messages go on that have way to go.
Step receive(std::uint8_t label, std::uint32_t count, int next = -1);

// A group's nodes, from node `first` of the job on, on their machines, which have `near` each. The group's first on a
// machine receives for it, where one of its nodes draws inbetweens.
class Machines {
 public:
  Machines(int first, int near, std::span<const std::uint8_t> draws);

  int nodes() const { return static_cast<int>(draws_.size()); }
  int head_of(int node) const;
  // The head of the next machine, in turn, that draws inbetweens; -1: there is none but the node's own.
  int next_head(int node) const;
  int heads() const { return static_cast<int>(std::ranges::count(collects_, 1)); }
  bool are_together(int a, int b) const { return head_of(a) == head_of(b); }
  bool draws(int node) const { return draws_[static_cast<std::size_t>(node)] == 1; }
  bool collects(int node) const { return collects_[static_cast<std::size_t>(node)] == 1; }

 private:
  int first_, near_;
  std::vector<std::uint8_t> draws_;  // 1: inbetweens
  std::vector<std::uint8_t> collects_;
};

// A vector of `bytes`, summed over all nodes (hal/collectives/reduction.cpp).
Exchange sum_steps(int nodes, double bytes);

// Triangles that a node has for the home of some lines (node/group/exchange.cpp).
struct Parcel {
  int home;
  std::uint64_t edge_boxes;
  std::uint64_t triangles;

  double bytes() const;
};

// `parcels`: of each node, for homes on other machines; `box_seconds`: of a home, for an edge box.
Exchange triangle_steps(const std::vector<std::vector<Parcel>>& parcels, double box_seconds);

// Whether what goes round machines takes time. Else it need not go all the way: nodes only wait for each other.
enum class Relayed { in_time, at_once };

// Lines that nodes keep for inbetweens, which go round machines (node/group/relay.cpp): of each node the messages.
Exchange still_steps(const Machines& machines, const std::vector<std::vector<double>>& messages,
                     Relayed relayed = Relayed::in_time);

// Bands of a keyframe that its group writes (node/group/band_exchange.cpp), of a node.
struct NodeBands {
  double edge = 0;                   // bytes of lines that begin in the band of another node
  int composer = -1;                 // of that band; -1: there is none
  bool composes = false;             // whole bands
  double picture = 0;                // for the file
  double encoding = 0;               // seconds
  std::vector<double> background{};  // bytes of bands for inbetweens, piece by piece
  double lines = 0;                  // that it encodes
};

Exchange band_steps(const Machines& machines, std::span<const NodeBands> bands, int writer,
                    Relayed relayed = Relayed::in_time);

}  // namespace mars::forecast
