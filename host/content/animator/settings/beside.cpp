#include "host/content/animator/settings/beside.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/written.h"
#include "host/content/animator/pose/actor_state.h"

namespace mars::animator {
namespace {

using modeler::Box;

constexpr double kFlat = 0.05;  // height against the shorter side of what is flat
constexpr double kMeet = 0.01;  // of a box's height and width: what meets less only stands on the other, or touches it
constexpr double kGap = 0.15;   // of the actor's width

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

void add_boxes(const Film& film, std::size_t actor, std::uint32_t frame, std::vector<Box>& boxes) {
  for (const auto& segment : state_at(film, actor, frame).segments)
    if (segment) boxes.push_back(around(*segment));
}

bool flat(const Box& box) {
  const glm::dvec3 size = box.max - box.min;
  return size.z < kFlat * std::min(size.x, size.y);
}

// `by` units along x.
bool meet(const Box& box, double by, const Box& other) {
  const glm::dvec3 spare = kMeet * (box.max - box.min);
  const auto apart = [&](int axis, double shift) {
    return box.max[axis] + shift - spare[axis] <= other.min[axis] || box.min[axis] + shift + spare[axis] >= other.max[axis];
  };
  return !(flat(box) && flat(other)) && !apart(0, by) && !apart(1, 0) && !apart(2, 0);
}

// The least way along x to where none of them meets any other. It only grows, past one of the others at a time.
double way_aside(const std::vector<Box>& boxes, const std::vector<Box>& others, double gap) {
  double by = 0;
  for (bool moved = true; moved;) {
    moved = false;
    for (const Box& box : boxes)
      for (const Box& other : others)
        if (meet(box, by, other)) {
          by = std::ceil((other.max.x - box.min.x + gap) * 100) / 100;
          moved = true;
        }
  }
  return by;
}

double width_of(const std::vector<Box>& boxes) {
  double least = boxes.front().min.x, most = boxes.front().max.x;
  for (const Box& box : boxes) {
    least = std::min(least, box.min.x);
    most = std::max(most, box.max.x);
  }
  return most - least;
}

}  // namespace

void place_beside(document::Json& film, const Film& meaning, const std::string& name, std::uint32_t frame) {
  std::vector<Box> boxes, others;
  for (std::size_t actor = 0; actor < meaning.actors.size(); ++actor)
    add_boxes(meaning, actor, frame, meaning.actors[actor].name == name ? boxes : others);
  if (boxes.empty()) return;
  const double by = way_aside(boxes, others, kGap * width_of(boxes));
  if (by == 0) return;
  document::Json& actor = actor_of(film, name);
  glm::dvec3 place = actor.contains("place") ? vector_of(actor.at("place")) : glm::dvec3(0);
  place.x = rounded(place.x + by);
  actor["place"] = written(place);
}

}  // namespace mars::animator
