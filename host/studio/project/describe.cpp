#include "host/studio/project/describe.h"

#include <algorithm>
#include <map>
#include <span>
#include <string_view>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/pose/attachments.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/things.h"
#include "host/content/animator/keys/written.h"
#include "host/content/modeler/edit.h"
#include "host/content/keys/page_keys.h"
#include "host/content/modeler/figure_library.h"
#include "host/content/modeler/limbs.h"
#include "host/content/modeler/read_model.h"
#include "host/content/modeler/shape_library.h"
#include "host/studio/project/model_film.h"

namespace mars::studio {
namespace {

using animator::written;

Json shown(const glm::dvec3& vector) { return written(animator::rounded(vector)); }

glm::dvec3 pose_of(const modeler::Joint& joint, const animator::Channel<glm::dvec3>& poses, std::uint32_t frame) {
  return animator::JointMotion(joint, poses).pose_at(frame);
}

template <typename Value>
bool has_key(const animator::Channel<Value>& channel, std::uint32_t frame) {
  return std::ranges::binary_search(channel, frame, {}, &animator::Key<Value>::frame);
}

// "left.knee", of each joint that is a limb.
std::map<std::size_t, std::string> limbs_of(const modeler::Model& model) {
  std::map<std::size_t, std::string> limbs;
  for (std::size_t part = 0; part < std::size(modeler::kTrunkNames); ++part)
    limbs[model.limbs.trunk[part]] = modeler::kTrunkNames[part];
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t limb = 0; limb < std::size(modeler::kLimbNames); ++limb)
      limbs[model.limbs.sides[side][limb]] = (side == 0 ? "left." : "right.") + std::string(modeler::kLimbNames[limb]);
  return limbs;
}

// What moves a joint.
Json joint_that_moves(const modeler::Model& model, const modeler::Joint& joint) {
  Json limits = Json::array(), free = Json::array();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    limits.push_back({written(joint.limits[axis].lower), written(joint.limits[axis].upper)});
    if (joint.limits[axis].free()) free.push_back(std::string(1, "xyz"[axis]));
  }
  Json json{{"name", joint.name}};
  if (joint.parent != modeler::kNone) json["parent"] = model.joints[joint.parent].name;
  json["limits"] = std::move(limits);
  json["free"] = std::move(free);
  return json;
}

void add_limb(Json& joint, const std::map<std::size_t, std::string>& limbs, std::size_t number) {
  if (const auto limb = limbs.find(number); limb != limbs.end()) joint["limb"] = limb->second;
}

Json segment_in(const Json& model, const std::string& joint) {
  if (model.contains("joints"))
    for (const Json& each : model["joints"])
      if (each.value("name", "") == joint) return each.value("segment", Json::object());
  return Json::object();
}

Json options_of(const Json& segment, const std::string& shape) {
  Json options = Json::object();
  const modeler::LibraryShape* const known = modeler::find_library_shape(shape);
  if (!known || known->option == nullptr) return options;
  const std::string key(known->option->name);
  options[key] = segment.contains(key) ? segment[key] : written(*known->option->number);
  return options;
}

// All that can be changed of it.
void add_shape(Json& json, const modeler::Model& model, const modeler::Joint& joint, const Json& file) {
  json["place"] = shown(joint.place);
  json["x_axis"] = shown(joint.x_axis);
  json["y_axis"] = shown(joint.y_axis);
  if (!joint.segment) return;
  const std::string& shape = model.shapes[joint.segment->shape].name;
  json["shape"] = shape;
  json["options"] = options_of(segment_in(file, joint.name), shape);
  json["sbb"] = {shown(joint.segment->sbb.min), shown(joint.segment->sbb.max)};
  json["material"] = joint.segment->material;
}

Json actor_head(const animator::Film& film, std::size_t number, std::uint32_t frame) {
  const animator::Actor& actor = film.actors[number];
  Json json{{"name", actor.name}};
  if (!actor.matrices.empty()) {
    json["matrices"] = true;
    return json;
  }
  const animator::ActorState state = animator::state_at(film, number, frame);
  json["place"] = shown(state.place);
  json["turn"] = shown(state.turn);
  return json;
}

Json material_of(const std::string& name, const wire::Material& material) {
  Json json{{"name", name}, {"color", shown({material.color[0], material.color[1], material.color[2]})}};
  json["reflection"] = modeler::word_of(material.reflection);
  json["interpolation"] = modeler::word_of(material.interpolation);
  json["sides"] = material.sides;
  for (const modeler::MaterialFlag& flag : modeler::kMaterialFlags)
    json[std::string(flag.key.name)] = material.*flag.member != 0;
  for (const modeler::MaterialNumber& number : modeler::kMaterialNumbers)
    if (modeler::uses(material.reflection, number))
      json[std::string(number.key.name)] = document::rounded_to(material.*number.member, 6);
  return json;
}

// Into `parts`, those that a key of a camera or a light sets.
void add_parts(std::set<std::string>& parts, const Json& key) {
  for (const auto& part : key.items())
    if (part.key() != "frame" && part.key() != "ease") parts.insert(part.key());
}

// What has a key of the file at the frame.
std::set<std::string> keyed_at(const Json& thing, std::uint32_t frame) {
  std::set<std::string> parts;
  if (thing.contains("keys"))
    for (const Json& key : thing["keys"])
      if (key.at("frame") == frame) add_parts(parts, key);
  return parts;
}

// Where the thing has it.
template <typename Value>
void add_part(Json& thing, std::string_view part, const animator::Channel<Value>& channel, std::uint32_t frame) {
  if (!channel.empty()) thing[std::string(part)] = written(animator::rounded(animator::value_at(channel, frame)));
}

// Those of the keys of the table that the object's kind has: what the file says or the default.
void add_values(Json& json, const keys::Object& object, unsigned kind, const Json& file) {
  for (const keys::Key& key : object.keys) {
    if (!key.typed || !key.is_of(kind)) continue;
    const std::string name(key.name);
    if (Json value = file.contains(name) ? file[name] : keys::default_of_pages(key); !value.is_null())
      json[name] = std::move(value);
  }
}

// Those that keys of the film may change, as they are at the frame.
void add_values(Json& json, std::span<const animator::KeyedPart> parts, std::uint32_t frame) {
  for (const animator::KeyedPart& part : parts)
    if (!part.unset) json[part.name] = part.value_at(frame);
}

Json light_of(const animator::LightMotion& light, std::size_t number, const Json& file, std::uint32_t frame) {
  const keys::Object& object = keys::object("light");
  const auto kind = static_cast<unsigned>(light.kind);
  Json json{{"thing", "light/" + std::to_string(number + 1)}, {"kind", object.kinds[kind].name}};
  add_values(json, object, kind, file);
  add_values(json, animator::light_parts(light), frame);
  json["keyed"] = keyed_at(file, frame);
  json["animated"] = keyed_parts(file);
  return json;
}

Json shapes() {
  Json shapes = Json::array();
  for (const modeler::LibraryShape& shape : modeler::shape_library()) {
    Json options = Json::array();
    if (const keys::Key* const option = shape.option)
      options.push_back({{"key", option->name},
                         {"what", option->meaning},
                         {"count", keys::count_of(*option)},
                         {"default", *option->number},
                         {"range", {option->range.lowest, option->range.highest}}});
    shapes.push_back({{"name", shape.name}, {"what", shape.what}, {"options", std::move(options)}});
  }
  return shapes;
}

Json shown_joint(const animator::Film& film, std::size_t actor, std::size_t joint) {
  Json json{{"actor", film.actors[actor].name}};
  if (joint != modeler::kNone) json["joint"] = film.models[film.actors[actor].model].joints[joint].name;
  return json;
}

// Null: the point is fixed at the frame.
Json followed(const animator::Film& film, const animator::Channel<animator::Point>& points, std::uint32_t frame) {
  const animator::Point& point = points[animator::stretch_at(points, frame).from].value;
  return point.actor == modeler::kNone ? Json() : shown_joint(film, point.actor, point.joint);
}

Json material_at(const animator::MaterialMotion& material, std::uint32_t frame) {
  Json json{{"name", material.name}, {"color", shown(animator::value_at(material.color, frame))}};
  json["reflection"] = modeler::word_of(material.shading.reflection);
  for (std::size_t i = 0; i < modeler::kMaterialNumbers.size(); ++i)
    if (modeler::uses(material.shading.reflection, modeler::kMaterialNumbers[i]))
      add_part(json, modeler::kMaterialNumbers[i].key.name, material.numbers[i], frame);
  return json;
}

Json limb_names() {
  Json names = Json::array();
  for (const std::string_view part : modeler::kTrunkNames) names.push_back(part);
  for (const char* side : {"left.", "right."})
    for (const std::string_view limb : modeler::kLimbNames) names.push_back(side + std::string(limb));
  return names;
}

}  // namespace

Json poses_of(const animator::Film& film, std::size_t actor, std::uint32_t frame) {
  Json json = actor_head(film, actor, frame);
  if (json.contains("matrices")) return json;
  const modeler::Model& model = film.models[film.actors[actor].model];
  Json poses = Json::array();
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint)
    poses.push_back(shown(pose_of(model.joints[joint], film.actors[actor].motion.pose[joint], frame)));
  json["joints"] = std::move(poses);
  return json;
}

std::set<std::string> keyed_parts(const Json& thing) {
  std::set<std::string> parts;
  if (thing.contains("keys"))
    for (const Json& key : thing["keys"]) add_parts(parts, key);
  return parts;
}

void describe_camera_and_lights(Json& project, const animator::Film& film, const Json& json, std::uint32_t frame) {
  Json camera{{"keyed", keyed_at(json.at("camera"), frame)}, {"animated", keyed_parts(json.at("camera"))}};
  add_values(camera, keys::object("camera"), static_cast<unsigned>(film.color), json.at("camera"));
  add_values(camera, animator::camera_parts(film), frame);
  camera["follow"] = followed(film, film.camera.eye, frame);
  camera["look"] = followed(film, film.camera.at, frame);
  project["camera"] = std::move(camera);
  Json lights = Json::array();
  for (std::size_t number = 0; json.contains("lights") && number < film.lights.size(); ++number)
    lights.push_back(light_of(film.lights[number], number, json["lights"][number], frame));
  project["lights"] = std::move(lights);
}

void describe_film(Json& project, const animator::Film& film, const Json& json, std::uint32_t frame) {
  Json actors = Json::array();
  for (std::size_t number = 0; number < film.actors.size(); ++number) {
    const animator::Actor& actor = film.actors[number];
    const modeler::Model& model = film.models[actor.model];
    const auto limbs = limbs_of(model);
    Json described = actor_head(film, number, frame), joints = Json::array();
    described["model"] = json["actors"][number].value("model", "");
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
      Json joint = joint_that_moves(model, model.joints[i]);
      if (actor.matrices.empty()) {
        joint["pose"] = shown(pose_of(model.joints[i], actor.motion.pose[i], frame));
        if (has_key(actor.motion.pose[i], frame)) joint["keyed"] = true;
      }
      add_limb(joint, limbs, i);
      joints.push_back(std::move(joint));
    }
    if (const animator::Attachment* const carrier = animator::attachment_at(actor, frame))
      described["attach"] = shown_joint(film, carrier->actor, carrier->joint);
    described["joints"] = std::move(joints);
    actors.push_back(std::move(described));
  }
  project["actors"] = std::move(actors);
  describe_camera_and_lights(project, film, json, frame);
  Json materials = Json::array();
  for (const animator::MaterialMotion& material : film.materials) materials.push_back(material_at(material, frame));
  project["materials"] = std::move(materials);
  project["keys"] = keys::keys_of_pages();
  add_values(project["settings"], keys::object("film"), static_cast<unsigned>(film.color), json);
}

void describe_model(Json& project, const animator::Film& film, const Json& json, std::uint32_t frame) {
  const modeler::Model& model = film.models[kModelActor];
  const auto limbs = limbs_of(model);
  Json actor = actor_head(film, kModelActor, frame), joints = Json::array();
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    Json joint = joint_that_moves(model, model.joints[i]);
    joint["pose"] = shown(pose_of(model.joints[i], film.actors[kModelActor].motion.pose[i], frame));
    add_shape(joint, model, model.joints[i], json);
    add_limb(joint, limbs, i);
    joints.push_back(std::move(joint));
  }
  actor["joints"] = std::move(joints);
  project["actors"] = Json::array({std::move(actor)});
  project["materials"] = Json::array();
  for (const modeler::NamedMaterial& material : model.materials)
    project["materials"].push_back(material_of(material.name, material.material));
  project["shapes"] = shapes();
  project["keys"] = keys::keys_of_pages();
  if (json.contains("shapes"))
    for (const auto& [name, shape] : json["shapes"].items())
      project["shapes"].push_back({{"name", name}, {"own", true}});
  project["limbs"] = limb_names();
  project["bodies"] = Json::array();
  for (const modeler::LibraryFigure& figure : modeler::figure_library())
    project["bodies"].push_back({{"name", figure.name}, {"what", figure.what}});
}

}  // namespace mars::studio
