#include "host/studio/project/step.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/document/text.h"

namespace mars::studio {
namespace {

constexpr std::string_view kScript = ".script";
constexpr std::size_t kLongestName = 100;
constexpr std::size_t kMostCommands = 200, kMostWords = 500;  // of a step; of a command
constexpr double kMostDegrees = 1e6;

[[noreturn]] void refuse(const char* problem, const char* where, const std::string& remedy) {
  throw Failure(problem, where, remedy);
}

editing::Command read_command(const Json& json) {
  if (!json.is_array() || json.empty() || json.size() > kMostWords)
    refuse("is no list of words", "a command of the step", "write 1 to " + std::to_string(kMostWords) + " words");
  editing::Command words;
  for (const Json& word : json) {
    if (!word.is_string()) refuse("is no text", "a word of the step", "write all words as texts");
    words.push_back(word.get<std::string>());
  }
  if (words[0] != "animate" && words[0] != "film" && words[0] != "model")
    refuse("changes no file", document::in_quotes(words[0]).c_str(), "begin a command with animate, film or model");
  return words;
}

CommandsStep read_commands(const Json& list) {
  if (!list.is_array() || list.empty() || list.size() > kMostCommands)
    refuse("are no list of commands", "commands", "write 1 to " + std::to_string(kMostCommands) + " commands");
  CommandsStep step;
  for (const Json& command : list) step.commands.push_back(read_command(command));
  return step;
}

ScriptStep read_script(const Json& script) {
  const auto is_text = [&](const char* key) { return script.contains(key) && script.at(key).is_string(); };
  const bool says_length = script.contains("lengthen") && script.at("lengthen").is_boolean();
  if (!script.is_object() || script.size() != (says_length ? 3 : 2) || !is_text("name") || !is_text("text"))
    refuse("has not the form of a script", "script",
           R"(write {"script": {"name": ..., "text": ..., "lengthen": true}})");
  return {checked_script_name(script.at("name").get<std::string>()), script.at("text").get<std::string>(),
          !says_length || script.at("lengthen").get<bool>()};
}

// To nine digits: what a hand's way computes, a person reads in the page.
glm::dvec3 read_turns(const Json& json) {
  const auto is_angle = [](const Json& number) {
    return number.is_number() && std::abs(number.get<double>()) <= kMostDegrees;
  };
  if (!json.is_array() || json.size() != 3 || !std::ranges::all_of(json, is_angle))
    refuse("is not three angles", "a joint of the pose", "write degrees about its x, y and z axes");
  return animator::rounded({json[0].get<double>(), json[1].get<double>(), json[2].get<double>()});
}

PoseStep read_pose(const Json& pose) {
  if (!pose.is_object()) refuse("has not the form of a pose", "pose", R"(write {"pose": {"JOINT": [X, Y, Z]}})");
  PoseStep step;
  for (const auto& [joint, turns] : pose.items()) step.pose[joint] = read_turns(turns);
  return step;
}

}  // namespace

std::string checked_script_name(const std::string& name) {
  const auto is_odd = [](unsigned char c) { return c < ' ' || c == 127 || c == '/'; };
  if (name.size() > kScript.size() && name.size() <= kLongestName && name.ends_with(kScript) && name.front() != '.' &&
      std::ranges::none_of(name, is_odd))
    return name;
  throw Failure("is no name of a script", document::in_quotes(name), "name it like visit.script, without a folder");
}

Step read_step(const Json& json) {
  if (json.is_object() && json.size() == 1) {
    if (const auto found = json.find("commands"); found != json.end()) return read_commands(*found);
    if (const auto found = json.find("script"); found != json.end()) return read_script(*found);
    if (const auto found = json.find("pose"); found != json.end()) return read_pose(*found);
  }
  refuse("is no step", "what the page says", "write one of commands, script and pose");
}

std::vector<editing::Command> commands_of(const Step& step) {
  if (const auto* commands = std::get_if<CommandsStep>(&step)) return commands->commands;
  const auto* script = std::get_if<ScriptStep>(&step);
  if (script == nullptr) return {};
  editing::Command command = {"animate", "script", script->name};
  if (script->lengthens) command.push_back("--lengthen");
  return {command};
}

}  // namespace mars::studio
