#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include "host/content/document/text.h"
#include "host/studio/project/step.h"

namespace mars::studio {
namespace {

using editing::Command;

std::string word_at(const Command& words, std::size_t i) {
  return i < words.size() ? document::shortened(words[i]) : std::string();
}

// The words before the first option.
std::vector<std::string> arguments_of(const Command& words) {
  std::vector<std::string> arguments;
  for (std::size_t i = 2; i < words.size() && !words[i].starts_with("--"); ++i) arguments.push_back(word_at(words, i));
  return arguments;
}

bool has(const Command& words, std::string_view option) { return std::ranges::find(words, option) != words.end(); }

std::string value_of(const Command& words, std::string_view option) {
  const auto at = std::ranges::find(words, option);
  return at == words.end() ? "" : word_at(words, static_cast<std::size_t>(at - words.begin()) + 1);
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

// "turn left-knee of pip", "turn 3 joints of pip", "move pip", "pose pip", "zoom the camera", "move light 2".
std::string name_of_pose(const Command& words) {
  std::vector<std::string> parts = arguments_of(words);
  if (parts.empty()) return "pose";
  const std::string thing = parts.front();
  parts.erase(parts.begin());
  for (std::string& part : parts) part.resize(std::min(part.find_first_of("=.+"), part.size()));
  const auto any_of = [&](std::initializer_list<std::string_view> names) {
    return std::ranges::any_of(parts, [&](const std::string& part) { return is_one_of(part, names); });
  };
  if (thing == "camera")
    return any_of({"eye", "at", "up"}) ? "move the camera"
           : any_of({"fov", "height"}) ? "zoom the camera"
                                       : "change the camera";
  if (thing.starts_with("light/"))
    return (any_of({"place", "at", "direction"}) ? "move light " : "change light ") + thing.substr(6);
  if (thing.starts_with("material/")) return "change material " + thing.substr(9);
  const auto joints = std::ranges::count_if(parts, [](const auto& part) {
    return !is_one_of(part, {"place", "turn"});
  });
  if (joints == 0) return (any_of({"place"}) ? "move " : "turn ") + thing;
  if (any_of({"place", "turn"})) return "pose " + thing;
  const std::string one = parts.front().starts_with('/') ? parts.front().substr(1) : parts.front();
  return "turn " + (joints == 1 ? one : document::counted(static_cast<std::size_t>(joints), "joint")) + " of " + thing;
}

// "place and limits".
std::string changed_parts(const Command& words) {
  constexpr std::pair<std::string_view, std::string_view> kParts[] = {
      {"--parent", "parent"}, {"--place", "place"}, {"--x-axis", "axes"},       {"--y-axis", "axes"},
      {"--fixed", "limits"},  {"--free", "limits"}, {"--limits", "limits"},     {"--shape", "shape"},
      {"--with", "shape"},    {"--sbb", "box"},     {"--material", "material"}, {"--limb", "limb"}};
  std::vector<std::string> parts;
  const auto add = [&](std::string part) {
    if (std::ranges::find(parts, part) == parts.end()) parts.push_back(std::move(part));
  };
  for (const auto& [option, part] : kParts)
    if (has(words, option)) add(std::string(part));
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (words[i] == "--reset") add(word_at(words, i + 1));
  return document::joined(parts, " and ");
}

std::string name_of_material(const std::string& verb, const Command& words) {
  const std::string material = "material " + value_of(words, "--material");
  if (verb != "set") return verb + " " + material;
  const bool renames = has(words, "--name") && words.size() == 6;
  return renames ? "rename " + material + " to " + value_of(words, "--name") : "change " + material;
}

std::string name_of_joint(const std::string& verb, const std::string& joint, const Command& words) {
  if (verb == "remove") return "remove " + joint + (has(words, "--branch") ? " and all on it" : "");
  if (verb == "add") return "add " + joint;
  const std::string parts = changed_parts(words);
  if (has(words, "--name") && parts.empty()) return "rename " + joint + " to " + value_of(words, "--name");
  return "change " + joint + (parts.empty() ? "" : "'s " + parts);
}

std::string name_of_mirror(const std::string& side, const std::string& joint) {
  return "mirror " + (joint.empty() ? "the " + side + " side" : joint) + " to the " +
         (side == "left" ? "right" : "left");
}

std::string name_of_model_command(const Command& words) {
  const std::string verb = word_at(words, 1);
  const std::vector<std::string> arguments = arguments_of(words);
  const std::string first = arguments.empty() ? "" : arguments[0];
  if (verb == "new") return "begin as the figure '" + value_of(words, "--figure") + "'";
  if (verb == "scale") return "change the proportions";
  if (verb == "point") return "pull a point of " + first;
  if (verb == "mirror") return name_of_mirror(first, arguments.size() > 1 ? arguments[1] : "");
  return first.empty() ? name_of_material(verb, words) : name_of_joint(verb, first, words);
}

// "walk tom", "move keys of tom", "add ball".
std::string name_of_command(const Command& words) {
  const std::string verb = word_at(words, 1), thing = word_at(words, 2) == "--all" ? "all" : word_at(words, 2);
  if (words[0] == "model") return name_of_model_command(words);
  if (words[0] == "animate" && verb == "pose") return name_of_pose(words);
  if (thing.empty() || thing.starts_with('-')) return verb;
  const bool keys = words[0] == "animate" && is_one_of(verb, {"move", "copy", "delete", "time", "reduce"});
  return verb + (keys ? " keys of " : " ") + thing;
}

std::string name_of_step(const CommandsStep& step) {
  std::set<std::string> names;
  for (const Command& words : step.commands) names.insert(name_of_command(words));
  const std::string first = name_of_command(step.commands.front());
  return names.size() == 1 ? first : first + " and " + std::to_string(names.size() - 1) + " more";
}

std::string name_of_step(const ScriptStep& step) { return "apply " + step.name; }

std::string name_of_step(const PoseStep&) { return "pose"; }

}  // namespace

std::string name_of(const Step& step) {
  return std::visit([](const auto& each) { return name_of_step(each); }, step);
}

}  // namespace mars::studio
