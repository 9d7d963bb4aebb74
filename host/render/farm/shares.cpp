#include "host/render/farm/shares.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "node/wire/protocol.h"

namespace mars::farm {
namespace {

// When the node is done with one more, in times that an inbetween usually takes.
double end_of_next(const Standing& node) { return static_cast<double>(node.waiting + 1) * node.slowness; }

bool keeps_up(const Standing& node) { return node.slowness <= 1 && node.waiting <= kMostBehind; }

// Those that are done at the same time come in turns.
class NextDone {
 public:
  NextDone(std::span<const Standing> nodes, std::uint64_t first_turn)
      : nodes_(nodes.begin(), nodes.end()), first_turn_(first_turn) {
    for (std::size_t member = 0; member < nodes_.size(); ++member) add(member);
  }

  std::int32_t take() {
    const std::size_t member = std::get<2>(queue_.top());
    queue_.pop();
    ++nodes_[member].waiting;
    add(member);
    return static_cast<std::int32_t>(member);
  }

 private:
  using Entry = std::tuple<double, std::size_t, std::size_t>;  // end, turn, member

  void add(std::size_t member) {
    const std::size_t count = nodes_.size();
    queue_.emplace(end_of_next(nodes_[member]), (member + count - first_turn_ % count) % count, member);
  }

  std::vector<Standing> nodes_;
  std::uint64_t first_turn_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

bool runs_short(std::span<const Standing> nodes) {
  constexpr double kFew = kTurnsInPortion / 2.0;
  const double soon = kFew * std::ranges::min(nodes, {}, &Standing::slowness).slowness;
  return std::ranges::any_of(nodes, [&](const Standing& node) { return end_of_next(node) <= soon; });
}

std::vector<std::int32_t> share_out(std::span<const Standing> nodes, std::uint64_t first_inbetween, std::size_t count) {
  if (count == 0 || std::ranges::all_of(nodes, keeps_up)) return {};
  const std::size_t length = std::min(count, wire::kMostCycle);
  std::vector<std::int32_t> cycle;
  for (std::size_t member = 0; member < nodes.size() && cycle.size() < length; ++member)
    if (nodes[member].forgotten) cycle.push_back(static_cast<std::int32_t>(member));
  NextDone next(nodes, first_inbetween);
  while (cycle.size() < length) cycle.push_back(next.take());
  // The film's inbetween n is drawn by cycle[n modulo its length].
  std::rotate(cycle.begin(), cycle.end() - static_cast<std::ptrdiff_t>(first_inbetween % length), cycle.end());
  return cycle;
}

}  // namespace mars::farm
