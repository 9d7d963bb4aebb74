#include "host/content/animator/keys/side_effects.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/animator/pose/figure.h"
#include "host/content/animator/keys/written.h"
#include "host/content/document/fields.h"
#include "host/content/document/shell_word.h"
#include "host/content/modeler/frames.h"

namespace mars::animator {
namespace {

constexpr double kNoTurn = 0.01;  // degrees
constexpr int kMostKeysShown = 3;

// From key to key, as its numbers say.
struct Way {
  const TrackKey& from;
  const TrackKey& to;

  glm::dvec3 start() const { return vector_of(from.value); }
  glm::dvec3 change() const { return vector_of(to.value) - start(); }
};

double largest(const glm::dvec3& change) {
  const glm::dvec3 size = glm::abs(change);
  return std::max({size.x, size.y, size.z});
}

// The one axis about which it turns; 3: several.
int only_axis(const glm::dvec3& change) {
  int only = 3, axes = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(change[axis]) > 0) only = axis, ++axes;
  return axes == 1 ? only : 3;
}

std::string degrees_text(double degrees) {
  const double rounded = std::round(std::abs(degrees) * 100) / 100;
  return document::shown(rounded) + (rounded == 1 ? " degree" : " degrees");
}

// "goes 90 degrees back"; "" where the smallest turn is what the numbers say.
std::string other_way(const modeler::Joint& joint, const Way& way) {
  const glm::dvec3 change = way.change();
  const glm::dmat3 start = modeler::orientation(joint, way.start());
  const Turn turn = turn_between(start, modeler::orientation(joint, way.start() + change));
  const double degrees = turn.angle / modeler::kDegree;
  if (const int axis = only_axis(change); axis < 3) {
    glm::dvec3 forward(0);
    forward[axis] = std::copysign(1, change[axis]);
    const Turn step = turn_between(start, modeler::orientation(joint, way.start() + forward));
    const double done = glm::dot(turn.axis, step.axis) < 0 ? -degrees : degrees;
    if (std::abs(done - std::abs(change[axis])) < kNoTurn) return "";
    if (degrees > kNoTurn) return "goes " + degrees_text(degrees) + (done < 0 ? " back" : " on");
  } else if (largest(change) <= 180) {
    return "";
  }
  return degrees > kNoTurn ? "goes only " + degrees_text(degrees) : "does not turn";
}

std::string asked_of(const glm::dvec3& change) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(change[axis]) > 0)
      text += (text.empty() ? "" : ", ") + degrees_text(change[axis]) + " about " + "xyz"[axis];
  return text;
}

// As a person types it: a joint called turn has its slash.
std::string typed_part(const std::string& part) {
  return part == "/turn" || part == "/place" ? part : shown_part(part);
}

std::string setting_for(const std::string& part, const glm::dvec3& change, const glm::dvec3& pose) {
  const auto number = [](double value) { return document::shown(std::round(value * 100) / 100); };
  if (const int axis = only_axis(change); axis < 3)
    return typed_part(part) + "." + "xyz"[axis] + "=" + number(pose[axis]);
  return typed_part(part) + "=" + number(pose.x) + "," + number(pose.y) + "," + number(pose.z);
}

// Keys between the two, less than half a turn apart.
std::string way_round(const Thing& thing, const std::string& part, const Way& way) {
  const glm::dvec3 change = way.change();
  const int pieces = static_cast<int>(largest(change) / 180) + 1;
  const std::uint32_t frames = way.to.frame - way.from.frame;
  if (frames < static_cast<std::uint32_t>(pieces)) return "there are too few frames between the two to go round";
  const std::string pose = "pose " + document::shell_word(thing.json->at("name").get<std::string>()) + " ";
  std::string text = "to go round, also ";
  for (int i = 1; i < pieces; ++i) {
    if (i > kMostKeysShown) return text + ", and so on";
    const double share = double(i) / pieces;
    text += (i == 1 ? "" : ", ") + pose + setting_for(part, change, way.start() + share * change) + " --frame " +
            std::to_string(way.from.frame + std::lround(share * frames));
  }
  return text;
}

bool same_orientation(const modeler::Joint& joint, const document::Json& a, const document::Json& b) {
  return turn_between(modeler::orientation(joint, vector_of(a)), modeler::orientation(joint, vector_of(b))).angle <
         kNoTurn * modeler::kDegree;
}

// Whether the way went as it goes now: between the same keys, or as a part of a way that went so.
bool went_so(const KeyedPart& part, const Way& way, const Track& before) {
  const modeler::Joint& joint = *part.turns;
  for (std::size_t i = 0; i + 1 < before.size(); ++i) {
    const Way old{before[i], before[i + 1]};
    if (old.from.value == way.from.value && old.to.value == way.to.value) return true;
    if (old.from.frame <= way.from.frame && way.to.frame <= old.to.frame && !other_way(joint, old).empty() &&
        same_orientation(joint, part.value_at(way.from.frame), way.from.value) &&
        same_orientation(joint, part.value_at(way.to.frame), way.to.value))
      return true;
  }
  return false;
}

void find_other_ways(const Thing& thing, const KeyedPart& part, const Track& before, const Track& after,
                     std::vector<std::string>& lines) {
  for (std::size_t i = 0; i + 1 < after.size(); ++i) {
    const Way way{after[i], after[i + 1]};
    if (way.from.ease.spline || way.from.ease.hold) continue;  // goes as its numbers say
    if (largest(way.change()) < 180) continue;
    const std::string goes = other_way(*part.turns, way);
    if (goes.empty() || went_so(part, way, before)) continue;
    lines.push_back(thing.name + ": " + shown_part(part.name) + " " + goes + " from frame " +
                    std::to_string(way.from.frame) + " to " + std::to_string(way.to.frame) + ", not " +
                    asked_of(way.change()) + ": from key to key it takes the smallest turn (" +
                    way_round(thing, part.name, way) + ")");
  }
}

}  // namespace

std::vector<std::string> side_effects(const Chosen& chosen, const Tracks& before, const Tracks& after) {
  const Track none;
  std::vector<std::string> lines;
  for (const auto& [name, track] : after)
    if (const KeyedPart& part = chosen.thing.part(name); part.turns) {
      const auto old = before.find(name);
      find_other_ways(chosen.thing, part, old == before.end() ? none : old->second, track, lines);
    }
  return lines;
}

}  // namespace mars::animator
