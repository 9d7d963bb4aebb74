#include "host/studio/stage/hand_words.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/attachments.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/document/text.h"

namespace mars::studio {
namespace {

// A name that begins with a dash would be an option before its "--".
editing::Command command_of(std::vector<std::string> verb, const std::vector<std::string>& names,
                            const std::vector<std::string>& options) {
  const bool dash = names.front().starts_with('-');
  editing::Command words = std::move(verb);
  if (!dash) words.insert(words.end(), names.begin(), names.end());
  words.insert(words.end(), options.begin(), options.end());
  if (!dash) return words;
  words.push_back("--");
  words.insert(words.end(), names.begin(), names.end());
  return words;
}

}  // namespace

Json step_of(const editing::Command& words) { return {{"commands", Json::array({words})}}; }

std::string shown_number(double number) { return document::shown(animator::rounded(number)); }

std::string shown_numbers(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ",") + shown_number(number);
  return text;
}

std::string shown_numbers(const glm::dvec3& vector) { return shown_numbers({vector.x, vector.y, vector.z}); }

std::string joint_setting(const std::string& joint, const glm::dvec3& pose) {
  const bool taken_otherwise = joint == "place" || joint == "turn" || joint.starts_with('-');
  return (taken_otherwise ? "/" : "") + joint + "=" + shown_numbers(pose);
}

Json posed_model(const std::map<std::string, glm::dvec3>& pose) {
  Json joints = Json::object();
  for (const auto& [joint, turns] : pose) {
    const glm::dvec3 shown = animator::rounded(turns);
    joints[joint] = {shown.x, shown.y, shown.z};
  }
  return {{"pose", std::move(joints)}};
}

Json pose_step(const Project& project, const std::string& thing, const std::vector<std::string>& settings) {
  std::vector<std::string> names{thing};
  names.insert(names.end(), settings.begin(), settings.end());
  return step_of(command_of({"animate", "pose"}, names, {"--frame", std::to_string(project.frame()), "--clamp"}));
}

Json set_step(const Project& project, const std::string& thing, const std::vector<std::string>& settings) {
  std::vector<std::string> keyed;
  editing::Command fixed{"film"};
  thing == "camera" ? fixed.push_back(thing) : void(fixed.insert(fixed.end(), {"light", "set", thing.substr(6)}));
  const std::size_t words = fixed.size();
  for (const std::string& setting : settings)
    (project.has_keys(thing, setting.substr(0, setting.find('='))) ? keyed : fixed).push_back(setting);
  Json step{{"commands", Json::array()}};
  if (fixed.size() > words) step["commands"].push_back(fixed);
  if (!keyed.empty()) step["commands"].push_back(pose_step(project, thing, keyed)["commands"][0]);
  return step;
}

Json blended(Json step, std::uint32_t frames) {
  if (frames == 0 || !step.contains("commands")) return step;
  for (Json& words : step["commands"])
    if (words.size() > 1 && words[0] == "animate" && words[1] == "pose")
      words.insert(std::find(words.begin(), words.end(), "--frame"), {"--falloff", std::to_string(frames)});
  return step;
}

void refuse_carried(const Project& project, std::size_t number) {
  const animator::Film& film = project.film();
  const animator::Actor& actor = film.actors[number];
  const animator::Attachment* const carrier = animator::attachment_at(actor, project.frame());
  if (!carrier) return;
  throw Failure("is carried by '" + film.actors[carrier->actor].name + "' at frame " + std::to_string(project.frame()),
                "actor '" + actor.name + "'", "detach it there, or move what carries it");
}

Json joint_step(const std::string& verb, const std::string& joint, const std::vector<std::string>& options) {
  return step_of(command_of({"model", verb}, {joint}, options));
}

void add_option(std::vector<std::string>& options, const char* name, std::initializer_list<double> numbers) {
  options.push_back(name);
  for (const double number : numbers) options.push_back(shown_number(number));
}

}  // namespace mars::studio
