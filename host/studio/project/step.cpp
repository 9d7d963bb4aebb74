#include "host/studio/project/step.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/animator/edit.h"
#include "host/content/animator/film.h"
#include "host/content/animator/read_lights.h"

namespace mars::studio {
namespace {

using document::Element;
using document::Fields;
using document::Kind;

constexpr document::Range kDegrees{-1e6, 1e6};
constexpr std::string_view kScript = ".script";
constexpr std::size_t kLongestName = 100;
constexpr std::size_t kMostCommands = 200, kMostWords = 500;  // of a step; of a command

constexpr std::string_view kPoseNames[] = {"set", "actor", "joint", "pose"};
constexpr std::string_view kPosesNames[] = {"set", "actor", "poses"};
constexpr std::string_view kPlaceNames[] = {"set", "actor", "place"};
constexpr std::string_view kTurnNames[] = {"set", "actor", "turn"};
constexpr std::string_view kFigureNames[] = {"set", "actor", "place", "turn", "poses"};
constexpr std::string_view kLightNames[] = {"set",   "light",     "place", "at",   "direction",
                                            "color", "intensity", "cone",  "reach"};
constexpr std::string_view kCameraNames[] = {"set", "eye", "at", "fov"};
constexpr std::string_view kJointNames[] = {"set", "add", "remove", "actor", "joint", "change", "branch"};
constexpr std::string_view kMaterialNames[] = {"set", "add", "remove", "material", "change"};
constexpr std::string_view kPointNames[] = {"set", "actor", "joint", "patch", "point", "to"};
constexpr std::string_view kMirrorNames[] = {"mirror", "joint"};
constexpr std::string_view kScaleNames[] = {"scale"};
constexpr std::string_view kBodyNames[] = {"body", "height"};
constexpr std::string_view kCommandsNames[] = {"commands"};
constexpr std::string_view kJointChangeNames[] = {"name",     "parent", "place", "x_axis",  "y_axis",
                                                  "freedom",  "limits", "shape", "options", "sbb",
                                                  "material", "limb",   "reset"};
constexpr std::string_view kMaterialChangeNames[] = {"name",       "color",      "ambient",       "diffuse",
                                                     "specular",   "exponent",   "roughness",     "metallic",
                                                     "refraction", "reflection", "interpolation", "sides"};
constexpr std::string_view kAxisNames[] = {"x", "y", "z"};

constexpr document::Keys kPose{"step", kPoseNames}, kPoses{"step", kPosesNames}, kPlace{"step", kPlaceNames},
    kTurn{"step", kTurnNames}, kFigure{"step", kFigureNames}, kLight{"step", kLightNames},
    kCamera{"step", kCameraNames}, kJoint{"step", kJointNames}, kMaterial{"step", kMaterialNames},
    kPoint{"step", kPointNames}, kMirror{"step", kMirrorNames}, kScale{"step", kScaleNames}, kBody{"step", kBodyNames},
    kCommands{"step", kCommandsNames}, kJointChange{"change", kJointChangeNames},
    kMaterialChange{"change", kMaterialChangeNames}, kLimits{"limits", kAxisNames};

// As a page may also say that there is none: null.
std::optional<Element> given(const Fields& fields, std::string_view key) {
  const auto element = fields.find(key);
  return element && element->kind() != Kind::null ? element : std::nullopt;
}

std::string text_or_none(const Fields& fields, std::string_view key) {
  const auto element = given(fields, key);
  return element ? document::read_text(*element) : "";
}

std::optional<std::string> text_given(const Fields& fields, std::string_view key) {
  const auto element = given(fields, key);
  return element ? std::optional(document::read_text(*element)) : std::nullopt;
}

// To nine digits: what a hand's way computes, a person will read in the file.
std::optional<glm::dvec3> vector_given(const Fields& fields, std::string_view key, document::Range range = {}) {
  const auto element = given(fields, key);
  return element ? std::optional(animator::rounded(document::read_vector(*element, range))) : std::nullopt;
}

std::optional<double> number_given(const Fields& fields, std::string_view key, document::Range range = {}) {
  const auto element = given(fields, key);
  return element ? std::optional(animator::rounded(document::read_number(*element, range))) : std::nullopt;
}

glm::dvec3 read_turns(const Element& element) { return animator::rounded(document::read_vector(element, kDegrees)); }

FigureStep read_pose(const Element& element) {
  const Fields fields(element, kPose);
  FigureStep step{text_or_none(fields, "actor")};
  step.poses[document::read_text(fields.required("joint"))] = read_turns(fields.required("pose"));
  return step;
}

FigureStep read_figure(const Element& element, const document::Keys& keys, std::string_view required) {
  const Fields fields(element, keys);
  if (!required.empty()) fields.required(required);
  FigureStep step{text_or_none(fields, "actor")};
  step.place = vector_given(fields, "place");
  step.turn = vector_given(fields, "turn", kDegrees);
  const auto poses = given(fields, "poses");
  if (!poses) return step;
  document::require_kind(*poses, Kind::object);
  for (const Element pose : *poses) step.poses[std::string(pose.key())] = read_turns(pose);
  return step;
}

CameraStep read_camera(const Element& element) {
  const Fields fields(element, kCamera);
  return {vector_given(fields, "eye"), vector_given(fields, "at"),
          number_given(fields, "fov", keys::range_of("camera", "fov"))};
}

glm::dvec2 read_cone(const Element& element) {
  document::require_size(element, 2);
  auto angle = element.begin();
  const double inner = animator::rounded(document::read_number(*angle, keys::range_of("light", "cone")));
  return {inner, animator::rounded(document::read_number(*++angle, keys::range_of("light", "cone")))};
}

LightStep read_light(const Element& element) {
  const Fields fields(element, kLight);
  LightStep step{document::read_count(fields.required("light"), 1,
                                      static_cast<std::uint32_t>(keys::range_of("film", "lights").highest))};
  step.place = vector_given(fields, "place");
  step.at = vector_given(fields, "at");
  step.direction = vector_given(fields, "direction");
  step.color = vector_given(fields, "color", {0, 1});
  step.intensity = number_given(fields, "intensity", keys::range_of("light", "intensity"));
  step.reach = number_given(fields, "reach", keys::range_of("light", "reach"));
  if (const auto cone = given(fields, "cone")) step.cone = read_cone(*cone);
  return step;
}

modeler::Freedom read_freedom(const Fields& fields) {
  constexpr std::string_view kWords[] = {"as it was", "fixed", "free"};
  return static_cast<modeler::Freedom>(fields.choice("freedom", 0, kWords));
}

void read_limits(const Element& element, modeler::JointChange& change) {
  const Fields fields(element, kLimits);
  for (const std::string_view axis : kAxisNames) {
    const auto range = given(fields, axis);
    if (!range) continue;
    document::require_size(*range, 2);
    auto bound = range->begin();
    const double lower = animator::rounded(document::read_number(*bound, kDegrees));
    change.limits.push_back({axis[0], {lower, animator::rounded(document::read_number(*++bound, kDegrees))}});
  }
}

void read_options(const Element& element, modeler::JointChange& change) {
  document::require_kind(element, Kind::object);
  for (const Element option : element) {
    std::vector<double> numbers;
    if (option.kind() == Kind::list)
      for (const Element number : option) numbers.push_back(animator::rounded(document::read_number(number)));
    else
      numbers.push_back(animator::rounded(document::read_number(option)));
    change.options.emplace_back(option.key(), std::move(numbers));
  }
}

modeler::Box read_box(const Element& element) {
  document::require_size(element, 2);
  auto corner = element.begin();
  const glm::dvec3 least = animator::rounded(document::read_vector(*corner));
  return {least, animator::rounded(document::read_vector(*++corner))};
}

void read_resets(const Element& element, modeler::JointChange& change) {
  document::require_kind(element, Kind::list);
  for (const Element what : element) change.reset.emplace_back(modeler::kResets[read_choice(what, modeler::kResets)]);
}

modeler::JointChange read_joint_change(const Element& element) {
  const Fields fields(element, kJointChange);
  modeler::JointChange change;
  change.name = text_given(fields, "name");
  change.parent = text_given(fields, "parent");
  change.place = vector_given(fields, "place");
  change.x_axis = vector_given(fields, "x_axis");
  change.y_axis = vector_given(fields, "y_axis");
  change.freedom = read_freedom(fields);
  if (const auto limits = given(fields, "limits")) read_limits(*limits, change);
  change.shape = text_given(fields, "shape");
  if (const auto options = given(fields, "options")) read_options(*options, change);
  if (const auto sbb = given(fields, "sbb")) change.sbb = read_box(*sbb);
  change.material = text_given(fields, "material");
  change.limb = text_given(fields, "limb");
  if (const auto reset = given(fields, "reset")) read_resets(*reset, change);
  return change;
}

JointStep read_joint(const Element& element, Verb verb) {
  const Fields fields(element, kJoint);
  JointStep step{verb, document::read_text(fields.required("joint")), {}, false};
  if (const auto change = given(fields, "change")) step.change = read_joint_change(*change);
  if (const auto branch = given(fields, "branch")) {
    document::require_kind(*branch, Kind::boolean);
    step.branch = branch->boolean();
  }
  return step;
}

modeler::MaterialChange read_material_change(const Fields& fields) {
  modeler::MaterialChange change;
  change.color = vector_given(fields, "color", {0, 1});
  for (std::size_t i = 0; i < change.numbers.size(); ++i)
    change.numbers[i] =
        number_given(fields, modeler::kMaterialNumbers[i].key.name, modeler::kMaterialNumbers[i].key.range);
  if (const auto word = given(fields, "reflection"))
    change.reflection = modeler::kReflections[read_choice(*word, modeler::kReflections)];
  if (const auto word = given(fields, "interpolation"))
    change.interpolation = modeler::kInterpolations[read_choice(*word, modeler::kInterpolations)];
  if (const auto sides = given(fields, "sides")) change.sides = static_cast<int>(document::read_count(*sides, 1, 2));
  return change;
}

MaterialStep read_material(const Element& element, Verb verb) {
  const Fields fields(element, kMaterial);
  MaterialStep step{verb, document::read_text(fields.required("material")), {}, {}};
  const auto change = given(fields, "change");
  if (!change) return step;
  const Fields changed(*change, kMaterialChange);
  step.change = read_material_change(changed);
  step.name = text_given(changed, "name");
  return step;
}

PointStep read_point(const Element& element) {
  constexpr std::uint32_t kMost = 1'000'000;
  const Fields fields(element, kPoint);
  const Element at = fields.required("point");
  document::require_size(at, 2);
  auto number = at.begin();
  const std::size_t i = document::read_count(*number, 0, kMost);
  const std::size_t j = document::read_count(*++number, 0, kMost);
  return {document::read_text(fields.required("joint")),
          {fields.count("patch", 0, 0, kMost), {i, j}, animator::rounded(read_vector(fields.required("to")))}};
}

MirrorStep read_mirror(const Element& element) {
  constexpr std::string_view kSides[] = {"left", "right"};
  const Fields fields(element, kMirror);
  return {static_cast<modeler::Side>(fields.choice("mirror", 0, kSides)), text_or_none(fields, "joint")};
}

BodyStep read_body(const Element& element) {
  const Fields fields(element, kBody);
  return {document::read_text(fields.required("body")), number_given(fields, "height", {1e-6, document::kFarthest})};
}

editing::Command read_command(const Element& element) {
  constexpr std::string_view kPrograms[] = {"animate", "film"};
  document::require_kind(element, Kind::list);
  editing::Command words;
  for (const Element word : element) words.push_back(document::read_text(word));
  if (words.empty() || words.size() > kMostWords)
    element.refuse("has " + document::counted(words.size(), "word"), "write 1 to " + std::to_string(kMostWords));
  document::read_choice(*element.begin(), kPrograms);
  return words;
}

CommandsStep read_commands(const Element& element) {
  const Fields fields(element, kCommands);
  const Element list = fields.required("commands");
  document::require_kind(list, Kind::list);
  if (list.size() == 0 || list.size() > kMostCommands)
    list.refuse("has " + document::counted(list.size(), "command"), "write 1 to " + std::to_string(kMostCommands));
  CommandsStep step;
  for (const Element command : list) step.commands.push_back(read_command(command));
  return step;
}

// Its text is longer than texts of files are.
ScriptStep read_script(const Json& json) {
  const Json& script = json.at("script");
  const auto is_text = [&](const char* key) { return script.contains(key) && script.at(key).is_string(); };
  if (json.size() != 1 || !script.is_object() || script.size() != 2 || !is_text("name") || !is_text("text"))
    throw Failure("has not the form of a script's step", "step", R"(write {"script": {"name": ..., "text": ...}})");
  return {checked_script_name(script.at("name").get<std::string>()), script.at("text").get<std::string>()};
}

Step read_set(const Element& element, const Element& what) {
  constexpr std::string_view kWhat[] = {"pose",   "poses", "place", "turn",     "figure",
                                        "camera", "light", "joint", "material", "point"};
  switch (document::read_choice(what, kWhat)) {
    case 0: return read_pose(element);
    case 1: return read_figure(element, kPoses, "poses");
    case 2: return read_figure(element, kPlace, "place");
    case 3: return read_figure(element, kTurn, "turn");
    case 4: return read_figure(element, kFigure, "");
    case 5: return read_camera(element);
    case 6: return read_light(element);
    case 7: return read_joint(element, Verb::set);
    case 8: return read_material(element, Verb::set);
    default: return read_point(element);
  }
}

Step read_other(const Element& element, const Element& what, Verb verb) {
  constexpr std::string_view kWhat[] = {"joint", "material"};
  if (document::read_choice(what, kWhat) == 0) return read_joint(element, verb);
  return read_material(element, verb);
}

Step read_element(const Element& element) {
  document::require_kind(element, Kind::object);
  if (const auto what = element.find("set")) return read_set(element, *what);
  if (const auto what = element.find("add")) return read_other(element, *what, Verb::add);
  if (const auto what = element.find("remove")) return read_other(element, *what, Verb::remove);
  if (element.find("mirror")) return read_mirror(element);
  if (const auto proportions = element.find("scale")) {
    const Fields fields(element, kScale);
    return ScaleStep{modeler::read_proportions(*proportions)};
  }
  if (element.find("body")) return read_body(element);
  if (element.find("commands")) return read_commands(element);
  element.refuse("is no step", "begin it with set, add, remove, mirror, scale, body, commands or script");
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
  if (json.is_object() && json.contains("script")) return read_script(json);
  const document::Document document(json.dump(-1, ' ', false, Json::error_handler_t::replace), "step");
  return read_element(document.root());
}

}  // namespace mars::studio
