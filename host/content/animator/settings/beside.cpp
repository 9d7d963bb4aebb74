#include "host/content/animator/settings/beside.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>
#include <vector>

#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/written.h"
#include "host/content/animator/pose/actor_state.h"

namespace mars::animator {
namespace {

using modeler::Box;

constexpr double kFlat = 0.05;  // height against the shorter side of what is flat
constexpr double kMeet = 0.01;  // of the actor's longest side: what meets by less only stands there, or touches
constexpr double kGap = 0.3;    // of its width
constexpr double kStage = 5;    // times as wide and as deep: another may stand in it, between its segments

constexpr std::size_t kMostStandings = 5000;  // of other actors: a page waits for them

// Around the unit cube that the matrix moves, along the world's axes.
Box around(const wire::Matrix& matrix) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& row = matrix.m[static_cast<std::size_t>(axis)];
    box.min[axis] = row[3] + std::min(row[0], 0.0) + std::min(row[1], 0.0) + std::min(row[2], 0.0);
    box.max[axis] = row[3] + std::max(row[0], 0.0) + std::max(row[1], 0.0) + std::max(row[2], 0.0);
  }
  return box;
}

struct Standing {
  std::vector<Box> segments;
  Box all;
};

Standing standing(const Film& film, std::size_t actor, std::uint32_t frame) {
  Standing found;
  for (const auto& segment : state_at(film, actor, frame).segments)
    if (segment) found.segments.push_back(around(*segment));
  if (found.segments.empty()) return found;
  found.all = found.segments.front();
  for (const Box& box : found.segments)
    found.all = {glm::min(found.all.min, box.min), glm::max(found.all.max, box.max)};
  return found;
}

bool flat(const Box& box) {
  const glm::dvec3 size = box.max - box.min;
  return size.z < kFlat * std::min(size.x, size.y);
}

// What of an actor may not meet another one; what stands on a ground may have its own.
std::vector<Box> obstacles(const Standing& of, const Standing& other) {
  const glm::dvec3 size = of.all.max - of.all.min, least = kStage * (other.all.max - other.all.min);
  const bool stage = size.x > least.x && size.y > least.y;
  return stage || flat(other.all) ? of.segments : std::vector{of.all};
}

// A box of the actor, and one in which it may not stand.
using Pairs = std::vector<std::pair<Box, Box>>;

void add_pairs(const Standing& actor, const Standing& other, Pairs& pairs) {
  for (const Box& box : obstacles(actor, other))
    for (const Box& obstacle : obstacles(other, actor))
      if (!flat(box) || !flat(obstacle)) pairs.emplace_back(box, obstacle);
}

// Adds the pairs of the other at the frame and at every `step`-th frame before it.
void add_pairs(const Standing& actor, const Film& film, std::size_t other, std::uint32_t frame, std::uint32_t step,
               Pairs& pairs) {
  Standing last;
  const auto add_at = [&](std::uint32_t at) {
    Standing there = standing(film, other, at);
    if (there.segments == last.segments) return;
    add_pairs(actor, there, pairs);
    last = std::move(there);
  };
  for (std::uint32_t at = frame; at > 0; at -= std::min(at, step)) add_at(at);
  add_at(0);
}

// By more than `spare`, with `box` `by` units along y.
bool meet(const Box& box, double by, const Box& other, double spare) {
  const auto apart = [&](int axis, double shift) {
    return box.max[axis] + shift - spare <= other.min[axis] || box.min[axis] + shift + spare >= other.max[axis];
  };
  return !apart(0, 0) && !apart(1, by) && !apart(2, 0);
}

// Whether the boxes of any pair meet; `by` is then the way past those that were met so far.
bool any_meet(const Pairs& pairs, double spare, double& by) {
  bool met = false;
  for (const auto& [box, other] : pairs) {
    if (!meet(box, by, other, spare)) continue;
    by = other.max.y - box.min.y;
    met = true;
  }
  return met;
}

// How far along y the actor stands beside all others; 0 where it stands in none.
double way_aside(Pairs pairs, const glm::dvec3& size) {
  const double spare = kMeet * std::max({size.x, size.y, size.z});
  double by = 0;
  if (!any_meet(pairs, spare, by)) return 0;
  for (auto& [box, other] : pairs) box.min.y -= kGap * size.y;
  while (any_meet(pairs, spare, by)) {
  }
  return std::ceil(by * 100) / 100;
}

}  // namespace

void place_beside(document::Json& film, const Film& meaning, const std::string& name, std::uint32_t frame) {
  const auto number = std::ranges::find(meaning.actors, name, &Actor::name) - meaning.actors.begin();
  const Standing own = standing(meaning, static_cast<std::size_t>(number), frame);
  if (own.segments.empty()) return;
  const auto step = static_cast<std::uint32_t>(1 + frame * meaning.actors.size() / kMostStandings);
  Pairs pairs;
  for (std::size_t other = 0; other < meaning.actors.size(); ++other)
    if (other != static_cast<std::size_t>(number)) add_pairs(own, meaning, other, frame, step, pairs);
  const double by = way_aside(std::move(pairs), own.all.max - own.all.min);
  if (by == 0) return;
  document::Json& actor = actor_of(film, name);
  glm::dvec3 place = actor.contains("place") ? vector_of(actor.at("place")) : glm::dvec3(0);
  place.y = rounded(place.y + by);
  actor["place"] = written(place);
}

}  // namespace mars::animator
