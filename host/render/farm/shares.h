// Which teams of a group draw its next inbetweens: in turns, as long as all keep up. Where a team is slow, or far
// behind, each goes to the team that would be done with it first. Most teams are one node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mars::farm {

// How a team of the group is getting on.
struct Standing {
  std::size_t waiting = 0;  // inbetweens that it was given and that have not come
  double slowness = 1;      // seconds that an inbetween takes it, over those that one usually takes
  bool forgotten = false;   // it is slow and had none for long: it is given one, to see whether it still is
};

// Inbetweens that are given to a group at a time, for each of its teams. A task of more is given in portions, so that
// what teams have drawn by then decides who draws the next.
inline constexpr std::size_t kTurnsInPortion = 8;
// A team that has more left when the next portion is due is far behind.
inline constexpr std::size_t kMostBehind = 12;

// Whether a team has so little left that the next portion is due.
bool runs_short(std::span<const Standing> nodes);

// The cycle (wire::Render) for `count` inbetweens from number `first_inbetween` of the film on; empty: turns.
std::vector<std::int32_t> share_out(std::span<const Standing> nodes, std::uint64_t first_inbetween, std::size_t count);

}  // namespace mars::farm
