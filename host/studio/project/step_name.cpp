#include <algorithm>
#include <set>
#include <vector>

#include "host/content/document/text.h"
#include "host/studio/project/step.h"

namespace mars::studio {
namespace {

// "turn left-knee of pip", "turn 3 joints", "move pip", "pose pip".
std::string name_of_step(const FigureStep& step) {
  const std::string figure = step.actor.empty() ? "the figure" : step.actor;
  if (step.poses.empty()) return (step.place ? "move " : "turn ") + figure;
  if (step.place || step.turn) return "pose " + figure;
  const std::string what =
      step.poses.size() == 1 ? step.poses.begin()->first : document::counted(step.poses.size(), "joint");
  return "turn " + what + (step.actor.empty() ? "" : " of " + step.actor);
}

std::string name_of_step(const LightStep& step) {
  const bool moves = step.place || step.at || step.direction;
  return (moves ? "move light " : "change light ") + std::to_string(step.light);
}

std::string name_of_step(const CameraStep& step) {
  return !step.eye && !step.at && step.fov ? "zoom the camera" : "move the camera";
}

// "place and limits".
std::string parts_of(const modeler::JointChange& change) {
  std::vector<std::string> parts;
  const auto add = [&](bool is, const char* name) {
    if (is) parts.emplace_back(name);
  };
  add(change.parent.has_value(), "parent");
  add(change.place.has_value(), "place");
  add(change.x_axis || change.y_axis, "axes");
  add(change.freedom != modeler::Freedom::as_it_was || !change.limits.empty(), "limits");
  add(change.shape || !change.options.empty(), "shape");
  add(change.sbb.has_value(), "box");
  add(change.material.has_value(), "material");
  add(change.limb.has_value(), "limb");
  for (const std::string& what : change.reset) parts.push_back(what);
  return document::joined(parts, " and ");
}

std::string name_of_step(const JointStep& step) {
  if (step.verb == Verb::add) return "add " + step.joint;
  if (step.verb == Verb::remove) return "remove " + step.joint + (step.branch ? " and all on it" : "");
  const std::string parts = parts_of(step.change);
  if (step.change.name && parts.empty()) return "rename " + step.joint + " to " + *step.change.name;
  return "change " + step.joint + (parts.empty() ? "" : "'s " + parts);
}

std::string name_of_step(const MaterialStep& step) {
  const std::string material = "material " + step.material;
  if (step.verb == Verb::add) return "add " + material;
  if (step.verb == Verb::remove) return "remove " + material;
  return step.name && !step.change.any() ? "rename " + material + " to " + *step.name : "change " + material;
}

std::string name_of_step(const PointStep& step) { return "pull a point of " + step.joint; }

std::string name_of_step(const MirrorStep& step) {
  const bool left = step.from == modeler::Side::left;
  return std::string("mirror ") + (step.joint.empty() ? (left ? "the left side" : "the right side") : step.joint) +
         (left ? " to the right" : " to the left");
}

std::string name_of_step(const ScaleStep&) { return "change the proportions"; }

std::string name_of_step(const BodyStep& step) { return "begin as the figure '" + step.body + "'"; }

// "walk tom", "move keys of tom", "add ball".
std::string name_of_command(const editing::Command& words) {
  constexpr std::string_view kOfKeys[] = {"move", "copy", "delete", "time", "reduce"};
  const auto word = [&](std::size_t i) { return i < words.size() ? document::shortened(words[i]) : std::string(); };
  const std::string verb = word(1), thing = word(2) == "--all" ? "all" : word(2);
  if (thing.empty() || thing.starts_with('-')) return verb;
  const bool keys = words[0] == "animate" && std::ranges::find(kOfKeys, verb) != std::end(kOfKeys);
  return verb + (keys ? " keys of " : " ") + thing;
}

std::string name_of_step(const CommandsStep& step) {
  std::set<std::string> names;
  for (const editing::Command& words : step.commands) names.insert(name_of_command(words));
  const std::string first = name_of_command(step.commands.front());
  return names.size() == 1 ? first : first + " and " + std::to_string(names.size() - 1) + " more";
}

std::string name_of_step(const ScriptStep& step) { return "apply " + step.name; }

}  // namespace

std::string name_of(const Step& step) {
  return std::visit([](const auto& each) { return name_of_step(each); }, step);
}

}  // namespace mars::studio
