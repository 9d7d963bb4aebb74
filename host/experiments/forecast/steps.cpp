#include "host/experiments/forecast/steps.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "hal/messages/message_types.h"
#include "node/wire/protocol.h"

namespace mars::forecast {
namespace {

constexpr double kShortSum = 64 << 10;  // hal/collectives/reduction.cpp
constexpr std::uint64_t kCacheLine = 64;

// A sum has one for each step, from the first on.
enum Label : std::uint8_t { kTriangles = 100, kStill, kStillThere, kEdge, kBackground, kBackgroundThere, kPicture };

Steps& of(Exchange& exchange, int node) { return exchange[static_cast<std::size_t>(node)]; }

void swap(Steps& steps, std::uint8_t label, int partner, double bytes) {
  steps.push_back(send(label, partner, bytes));
  steps.push_back(receive(label, 1));
}

// Across the dimensions of the group's hypercube.
void sum_at_corner(Steps& steps, int node, int corners, double bytes) {
  std::uint8_t label = 2;
  if (bytes < kShortSum || corners < 4) {
    for (int bit = 1; bit < corners; bit *= 2) swap(steps, label++, node ^ bit, bytes);
    return;
  }
  double part = bytes;
  for (int bit = 1; bit < corners; bit *= 2) swap(steps, label++, node ^ bit, part /= 2);
  for (int bit = corners / 2; bit > 0; bit /= 2, part *= 2) swap(steps, label++, node ^ bit, part);
}

// The head of each machine waits for what is sent to it, then says so to the machine's nodes.
void collect(Steps& steps, const Machines& machines, int node, const Step& messages, std::uint8_t there) {
  if (!machines.collects(node)) {
    if (machines.draws(node)) steps.push_back(receive(there, 1));
    return;
  }
  if (messages.count > 0) steps.push_back(messages);
  for (int other = node + 1; other < machines.nodes() && machines.are_together(node, other); ++other)
    if (machines.draws(other)) steps.push_back(send(there, other, 0));
}

// Labels of what goes round machines, and of the word that all of it is there.
struct RelayLabels {
  std::uint8_t pieces, there;
};

// Where a ring would have more messages than that, or than some for each node, neighbouring pieces are taken as one:
// the ring is full of them anyway.
constexpr std::size_t kManyPieces = 512, kManyOfANode = 4;

std::vector<std::vector<double>> with_few_pieces(std::vector<std::vector<double>> pieces) {
  std::size_t all = 0;
  for (const std::vector<double>& own : pieces) all += own.size();
  const std::size_t together = all / std::max(kManyPieces, kManyOfANode * pieces.size()) + 1;
  if (together == 1) return pieces;
  for (std::vector<double>& own : pieces) {
    std::vector<double> few;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (i % together == 0) few.push_back(0);
      few.back() += own[i];
    }
    own = std::move(few);
  }
  return pieces;
}

// More machines that wait for each other do so at one of them.
constexpr int kLargeRing = 256;

// What a ring is where messages take no time: every node that has pieces, or receives them, waits for all such nodes.
void meet(Exchange& exchange, const Machines& machines, const std::vector<std::vector<double>>& pieces,
          const RelayLabels& labels) {
  const auto comes = [&](int node) {
    return machines.collects(node) || !pieces[static_cast<std::size_t>(node)].empty();
  };
  int first = 0;
  std::uint32_t others = 0;
  while (!machines.collects(first)) ++first;
  for (int node = 0; node < machines.nodes(); ++node) others += node != first && comes(node) ? 1 : 0;
  for (int node = 0; node < machines.nodes(); ++node) {
    Steps& steps = of(exchange, node);
    if (node != first && comes(node)) steps.push_back(send(labels.pieces, first, 0));
    collect(steps, machines, node, receive(labels.pieces, node == first ? others : 1), labels.there);
    for (int head = 0; node == first && head < machines.nodes(); ++head)
      if (head != first && machines.collects(head)) steps.push_back(send(labels.pieces, head, 0));
  }
}

// `all_pieces` of each node go to the next machine that draws inbetweens, whose head passes them on, until they have
// been to all others. A node says its own head when what it has is there.
void relay(Exchange& exchange, const Machines& machines, const std::vector<std::vector<double>>& all_pieces,
           const RelayLabels& labels, Relayed relayed) {
  if (relayed == Relayed::at_once && machines.heads() > kLargeRing) return meet(exchange, machines, all_pieces, labels);
  const std::vector<std::vector<double>> pieces = with_few_pieces(all_pieces);
  std::uint32_t all = 0;
  for (const std::vector<double>& own : pieces) all += static_cast<std::uint32_t>(own.size());
  for (int node = 0; node < machines.nodes(); ++node) {
    Steps& steps = of(exchange, node);
    const std::vector<double>& own = pieces[static_cast<std::size_t>(node)];
    const int head = machines.head_of(node), next = machines.next_head(node);
    const int receivers = machines.heads() - (machines.collects(head) ? 1 : 0);
    if (node != head && !own.empty() && machines.collects(head)) steps.push_back(send(labels.pieces, head, 0));
    for (std::size_t i = 0; i < own.size() && next >= 0; ++i) {
      steps.push_back(send(labels.pieces, next, own[i]));
      steps.back().count = static_cast<std::uint32_t>(receivers - 1);
    }
    std::uint32_t near = 0, telling = 0;
    for (int other = head; other < machines.nodes() && machines.are_together(node, other); ++other) {
      const auto count = static_cast<std::uint32_t>(pieces[static_cast<std::size_t>(other)].size());
      near += count;
      telling += other != node && count > 0 ? 1 : 0;
    }
    collect(steps, machines, node, receive(labels.pieces, all - near + telling, next), labels.there);
  }
}

}  // namespace

long message_type(std::uint8_t label) {
  switch (label) {
    case kTriangles: return wire::kTriangles;
    case kStill:
    case kStillThere: return wire::kStillLines;
    case kEdge: return wire::kEdge;
    case kBackground:
    case kBackgroundThere: return wire::kBackground;
    case kPicture: return wire::kPicture;
    default: return messages::kFirstInternalType;
  }
}

Step work(double seconds) { return {Step::Kind::work, 0, -1, 0, 0, seconds}; }

Step send(std::uint8_t label, int to, double bytes, double seconds) {
  return {Step::Kind::send, label, to, 0, bytes, seconds};
}

Step receive(std::uint8_t label, std::uint32_t count, int next) {
  return {Step::Kind::receive, label, next, count, 0, 0};
}

Machines::Machines(int first, int near, std::span<const std::uint8_t> draws)
    : first_(first), near_(near), draws_(draws.begin(), draws.end()), collects_(draws.size()) {
  for (int node = 0; node < nodes(); ++node)
    if (this->draws(node)) collects_[static_cast<std::size_t>(head_of(node))] = 1;
}

int Machines::head_of(int node) const { return std::max(0, (first_ + node) / near_ * near_ - first_); }

int Machines::next_head(int node) const {
  for (int i = 1; i < nodes(); ++i)
    if (const int other = (node + i) % nodes(); collects(other) && !are_together(node, other)) return other;
  return -1;
}

Exchange sum_steps(int nodes, double bytes) {
  const auto corners = static_cast<int>(std::bit_floor(static_cast<unsigned>(nodes)));
  Exchange exchange(static_cast<std::size_t>(nodes));
  for (int node = 0; node < nodes; ++node) {
    Steps& steps = of(exchange, node);
    if (node >= corners) {
      steps = {send(0, node - corners, bytes), receive(1, 1)};
      continue;
    }
    const bool folds = node + corners < nodes;
    if (folds) steps.push_back(receive(0, 1));
    sum_at_corner(steps, node, corners, bytes);
    if (folds) steps.push_back(send(1, node + corners, bytes));
  }
  return exchange;
}

double Parcel::bytes() const {
  const std::uint64_t boxes = (edge_boxes * kUnsortedBoxBytes + kCacheLine - 1) / kCacheLine * kCacheLine;
  return static_cast<double>(kCacheLine + boxes + triangles * kTriangleBytes);
}

// Each node sends to the homes behind it first.
Exchange triangle_steps(const std::vector<std::vector<Parcel>>& parcels, double box_seconds) {
  const auto nodes = static_cast<int>(parcels.size());
  Exchange exchange(parcels.size());
  std::vector<std::uint32_t> coming(parcels.size());
  for (int node = 0; node < nodes; ++node) {
    std::vector<Parcel> in_order = parcels[static_cast<std::size_t>(node)];
    std::ranges::sort(in_order, {}, [&](const Parcel& parcel) { return (parcel.home - node + nodes) % nodes; });
    for (const Parcel& parcel : in_order) {
      of(exchange, node)
          .push_back(
              send(kTriangles, parcel.home, parcel.bytes(), box_seconds * static_cast<double>(parcel.edge_boxes)));
      ++coming[static_cast<std::size_t>(parcel.home)];
    }
  }
  for (int node = 0; node < nodes; ++node)
    if (const std::uint32_t count = coming[static_cast<std::size_t>(node)]; count > 0)
      of(exchange, node).push_back(receive(kTriangles, count));
  return exchange;
}

Exchange still_steps(const Machines& machines, const std::vector<std::vector<double>>& messages, Relayed relayed) {
  Exchange exchange(messages.size());
  relay(exchange, machines, messages, {kStill, kStillThere}, relayed);
  return exchange;
}

Exchange band_steps(const Machines& machines, std::span<const NodeBands> bands, int writer, Relayed relayed) {
  const int nodes = machines.nodes();
  Exchange exchange(bands.size());
  std::uint32_t composing = 0;
  std::vector<std::uint32_t> edges(bands.size());
  for (const NodeBands& own : bands) {
    composing += own.composes ? 1 : 0;
    if (own.composer >= 0) ++edges[static_cast<std::size_t>(own.composer)];
  }
  for (int node = 0; node < nodes; ++node) {
    const NodeBands& own = bands[static_cast<std::size_t>(node)];
    Steps& steps = of(exchange, node);
    if (own.composer >= 0) steps.push_back(send(kEdge, own.composer, own.edge));
    if (const std::uint32_t count = edges[static_cast<std::size_t>(node)]; count > 0)
      steps.push_back(receive(kEdge, count));
    if (own.encoding > 0) steps.push_back(work(own.encoding));
  }
  std::vector<std::vector<double>> background;
  for (const NodeBands& own : bands) background.push_back(own.composes ? own.background : std::vector<double>());
  relay(exchange, machines, background, {kBackground, kBackgroundThere}, relayed);
  for (int node = 0; node < nodes; ++node)
    if (const NodeBands& own = bands[static_cast<std::size_t>(node)]; own.composes && node != writer)
      of(exchange, node).push_back(send(kPicture, writer, own.picture));
  const std::uint32_t others = composing - (bands[static_cast<std::size_t>(writer)].composes ? 1 : 0);
  if (others > 0) of(exchange, writer).push_back(receive(kPicture, others));
  return exchange;
}

}  // namespace mars::forecast
