// A step as a page says it (docs/studio-protocol.md), read: kinds, ranges and names of its keys are checked here, what
// it names in a film or model is not.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "host/content/document/json_file.h"
#include "host/content/modeler/edit.h"
#include "host/content/modeler/edit_shapes.h"
#include "host/content/modeler/limbs.h"
#include "host/content/modeler/proportions.h"
#include "host/editing/edit_film.h"

namespace mars::studio {

using document::Json;

// A figure as a whole, and its joints' turns, degrees, within any limits or not.
struct FigureStep {
  std::string actor;
  std::optional<glm::dvec3> place{}, turn{};
  std::map<std::string, glm::dvec3> poses{};
};

struct CameraStep {
  std::optional<glm::dvec3> eye, at;
  std::optional<double> fov;
};

// Of the lights that the film has.
struct LightStep {
  std::size_t light;  // from 1
  std::optional<glm::dvec3> place{}, at{}, direction{}, color{};
  std::optional<double> intensity{}, reach{};
  std::optional<glm::dvec2> cone{};  // inner and outer, degrees
};

enum class Verb { set, add, remove };

struct JointStep {
  Verb verb;
  std::string joint;
  modeler::JointChange change;
  bool branch = false;  // removed with all that hangs on it
};

struct MaterialStep {
  Verb verb;
  std::string material;
  modeler::MaterialChange change;
  std::optional<std::string> name;  // a new one
};

struct PointStep {
  std::string joint;
  modeler::ControlPoint point;
};

struct MirrorStep {
  modeler::Side from;
  std::string joint;  // where the branch begins; "": all
};

struct ScaleStep {
  modeler::Proportions proportions;
};

struct BodyStep {
  std::string body;
  std::optional<double> height;
};

// Words after `mars`, without the film.
struct CommandsStep {
  std::vector<editing::Command> commands;
};

// A script beside the film, written and applied.
struct ScriptStep {
  std::string name, text;
};

using Step = std::variant<FigureStep, CameraStep, LightStep, JointStep, MaterialStep, PointStep, MirrorStep, ScaleStep,
                          BodyStep, CommandsStep, ScriptStep>;

// Throws Failure where it is no file's name that ends in ".script".
std::string checked_script_name(const std::string& name);

// Throws Failure.
Step read_step(const Json& json);

// What it does, as people would name it in a history: "turn left-knee".
std::string name_of(const Step& step);

}  // namespace mars::studio
