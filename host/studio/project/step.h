// A step as a page or a hand says it (docs/studio-protocol.md): words of commands, and two things that no command has.
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "host/content/document/json_file.h"
#include "host/editing/command.h"

namespace mars::studio {

using document::Json;

// Words after `mars`, without the file.
struct CommandsStep {
  std::vector<editing::Command> commands;
};

// A script beside the film, written and applied.
struct ScriptStep {
  std::string name, text;
  bool lengthens = true;  // the film, where the script ends later
};

// How joints of a model that is open are turned, degrees: for trying out, no file has it.
struct PoseStep {
  std::map<std::string, glm::dvec3> pose;
};

using Step = std::variant<CommandsStep, ScriptStep, PoseStep>;

// Throws Failure where it is no file's name that ends in ".script".
std::string checked_script_name(const std::string& name);

// Throws Failure.
Step read_step(const Json& json);

// The commands that do the same; none of a pose for trying out.
std::vector<editing::Command> commands_of(const Step& step);

// What it does, as people would name it in a history: "turn left-knee".
std::string name_of(const Step& step);

}  // namespace mars::studio
