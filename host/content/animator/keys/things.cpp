#include "host/content/animator/keys/things.h"

#include <fnmatch.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/camera_points.h"
#include "host/content/animator/pose/direction.h"
#include "host/content/animator/pose/keyed_channels.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/tracks.h"
#include "host/content/animator/keys/written.h"
#include "host/content/document/fields.h"

namespace mars::animator {
namespace {

// What a person types before a light's number, a material's name.
constexpr std::string_view kLight = "light/", kMaterial = "material/";
constexpr std::size_t kMostNames = 40;  // in a message

template <typename Value>
KeyedPart plain(std::string_view name, const Channel<Value>& channel) {
  if (channel.empty())
    return {.name = std::string(name),
            .joint = nullptr,
            .turns = nullptr,
            .value_at = [](std::uint32_t) { return written(Value{}); },
            .unset = true};
  return {std::string(name), nullptr, nullptr, [&channel](std::uint32_t frame) {
            const Stretch stretch = stretch_at(channel, frame);
            if (stretch.from == stretch.to) return written(channel[stretch.from].value);
            return written(rounded(value_at(channel, frame)));
          }};
}

KeyedPart direction(const Channel<glm::dvec3>& channel) {
  return {"direction", nullptr, nullptr,
          [&channel](std::uint32_t frame) { return written(rounded(direction_at(channel, frame))); }};
}

KeyedPart turning(const std::string& name, const modeler::Joint& joint, const Channel<glm::dvec3>& poses,
                  bool limited) {
  const auto motion = std::make_shared<JointMotion>(joint, poses);
  const modeler::Joint* turns = joint.freedoms() > 1 ? &joint : nullptr;
  return {name, limited ? &joint : nullptr, turns, [motion, &poses](std::uint32_t frame) {
            const glm::dvec3 pose = motion->pose_at(frame);
            if (poses.empty()) return written(pose);
            const Stretch stretch = stretch_at(poses, frame);
            return written(stretch.from == stretch.to ? pose : rounded(pose));
          }};
}

// What is kept from key to key.
KeyedPart carried(const Film& film, const Channel<std::optional<Attachment>>& channel) {
  return {"attach", nullptr, nullptr, [](std::uint32_t) { return nullptr; },
          [&film, &channel](std::uint32_t frame) -> document::Json {
            if (channel.empty() || frame < channel.front().frame) return nullptr;
            const auto& held = channel[stretch_at(channel, frame).from].value;
            if (!held) return nullptr;
            const Actor& carrier = film.actors[held->actor];
            const bool whole = held->joint == modeler::kNone;
            return written(AttachKey{carrier.name, whole ? "" : film.models[carrier.model].joints[held->joint].name,
                                     held->place, held->turn});
          }};
}

KeyedPart point(std::string_view name, const Film& film, const Channel<Point>& channel) {
  const auto place = [&film, &channel](std::uint32_t frame) {
    const Stretch stretch = stretch_at(channel, frame);
    JointFrames frames(film);
    const glm::dvec3 at = place_at(channel, frame, frames);
    const bool given = stretch.from == stretch.to && channel[stretch.from].value.actor == modeler::kNone;
    return written(given ? at : rounded(at));
  };
  return {std::string(name), nullptr, nullptr, place, [&film, &channel, place](std::uint32_t frame) {
            const Stretch stretch = stretch_at(channel, frame);
            return stretch.from == stretch.to ? written(channel[stretch.from].value, film) : place(frame);
          }};
}

KeyedPart keyed_part(const keys::Key& key, const Channel<glm::dvec3>& channel) {
  return key.name == "direction" ? direction(channel) : plain(key.name, channel);
}

template <typename Value>
KeyedPart keyed_part(const keys::Key& key, const Channel<Value>& channel) {
  return plain(key.name, channel);
}

KeyedPart keyed_part(const keys::Key& key, const Film& film, const Channel<Point>& channel) {
  return point(key.name, film, channel);
}

template <typename Value>
KeyedPart keyed_part(const keys::Key& key, const Film&, const Channel<Value>& channel) {
  return keyed_part(key, channel);
}

Thing thing_of(std::string name, document::Json& json, std::vector<KeyedPart> parts) {
  Thing thing{std::move(name), &json, false, {}};
  for (KeyedPart& part : parts) (part.unset ? thing.unset : thing.parts).push_back(std::move(part));
  return thing;
}

Thing thing_of_camera(document::Json& film, const Film& meaning) {
  return thing_of("camera", film.at("camera"), camera_parts(meaning));
}

// `number` counts from 1.
Thing thing_of_light(document::Json& json, const Film& film, std::size_t number) {
  return thing_of(std::string(kLight) + std::to_string(number), json, light_parts(film.lights[number - 1]));
}

Thing thing_of_material(document::Json& json, const MaterialMotion& material) {
  std::vector<KeyedPart> parts{plain("color", material.color)};
  for (std::size_t i = 0; i < modeler::kMaterialNumbers.size(); ++i)
    if (uses(material.shading.reflection, modeler::kMaterialNumbers[i]))
      parts.push_back(plain(modeler::kMaterialNumbers[i].key.name, material.numbers[i]));
  return {std::string(kMaterial) + material.name, &json, false, std::move(parts)};
}

Thing thing_of_actor(document::Json& json, const Film& film, const Actor& actor) {
  const modeler::Model& model = film.models[actor.model];
  Thing thing{"actor '" + actor.name + "'", &json, true, {plain("place", actor.motion.place)}};
  thing.parts.push_back(turning("turn", free_joint(), actor.motion.turn, false));
  thing.parts.push_back(carried(film, actor.attach));
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    thing.parts.push_back(turning("/" + model.joints[i].name, model.joints[i], actor.motion.pose[i], true));
  return thing;
}

std::vector<std::string> names_of(const Thing& thing) {
  std::vector<std::string> names;
  for (const KeyedPart& part : thing.parts) names.push_back(part.name);
  return names;
}

Chosen whole(Thing thing) {
  std::vector<std::string> parts = names_of(thing);
  return {std::move(thing), std::move(parts)};
}

std::vector<Chosen> everything(document::Json& film, const Film& meaning) {
  std::vector<Chosen> all = {whole(thing_of_camera(film, meaning))};
  if (const auto lights = film.find("lights"); lights != film.end())
    for (std::size_t i = 0; i < lights->size(); ++i) all.push_back(whole(thing_of_light((*lights)[i], meaning, i + 1)));
  for (const MaterialMotion& material : meaning.materials)
    all.push_back(whole(thing_of_material(film["materials"][material.name], material)));
  for (std::size_t i = 0; i < meaning.actors.size(); ++i) {
    const Actor& actor = meaning.actors[i];
    if (actor.matrices.empty()) all.push_back(whole(thing_of_actor(film["actors"][i], meaning, actor)));
  }
  return all;
}

[[noreturn]] void refuse_name(const std::string& name, const Film& meaning) {
  std::vector<std::string_view> names = {"camera"};
  for (const Actor& actor : meaning.actors) names.push_back(actor.name);
  throw Failure("is no actor of the film, nor its camera, light/N or material/NAME", "'" + name + "'",
                document::did_you_mean(name, names, "`mars animate FILM list` shows what has keys"));
}

Thing light_named(document::Json& film, const Film& meaning, const std::string& name) {
  const auto lights = film.find("lights");
  if (lights == film.end())
    throw Failure("has no lights of its own: those it is shown with stand in no file", meaning.source,
                  "write them into the film: mars film FILM light rig");
  const auto number = document::number_in<std::size_t>(std::string_view(name).substr(kLight.size()));
  if (!number || *number < 1 || *number > lights->size())
    throw Failure("is no light of the film", "'" + name + "'",
                  lights->empty() ? "it has none: mars film FILM light add"
                                  : "its lights are light/1 to light/" + std::to_string(lights->size()));
  return thing_of_light((*lights)[*number - 1], meaning, *number);
}

Thing material_named(document::Json& film, const Film& meaning, const std::string& name) {
  const std::string wanted = name.substr(kMaterial.size());
  std::vector<std::string_view> names;
  for (const MaterialMotion& material : meaning.materials) {
    if (material.name == wanted) return thing_of_material(film["materials"][wanted], material);
    names.push_back(material.name);
  }
  throw Failure("is no material of the film", "'" + name + "'",
                document::did_you_mean(wanted, names,
                                       "one of a model becomes the film's by: mars film FILM material add " + wanted +
                                           " --actor ACTOR"));
}

Thing thing_named(document::Json& film, const Film& meaning, const std::string& name) {
  for (std::size_t i = 0; i < meaning.actors.size(); ++i) {
    const Actor& actor = meaning.actors[i];
    if (actor.name != name) continue;
    if (!actor.matrices.empty())
      throw Failure("is moved by matrices, which have no keys", "actor '" + name + "'",
                    "change its matrices in the tool they came from");
    return thing_of_actor(film.at("actors")[i], meaning, actor);
  }
  if (name.starts_with(kLight)) return light_named(film, meaning, name);
  if (name.starts_with(kMaterial)) return material_named(film, meaning, name);
  if (name != "camera") refuse_name(name, meaning);
  return thing_of_camera(film, meaning);
}

bool can_change(const KeyedPart& part) { return !part.joint || part.joint->freedoms() > 0; }

std::vector<std::string> parts_that_change(const Thing& thing) {
  std::vector<std::string> names;
  for (const KeyedPart& part : thing.parts)
    if (can_change(part)) names.push_back(part.name);
  return names;
}

[[noreturn]] void refuse_pattern(const Thing& thing, const std::string& pattern) {
  std::vector<std::string> names;
  for (const std::string& name : parts_that_change(thing)) names.push_back(shown_part(name));
  const bool more = names.size() > kMostNames;
  names.resize(std::min(names.size(), kMostNames));
  throw Failure("has no part like '" + pattern + "'", thing.name,
                "its parts are: " + document::joined(names) + (more ? " ..." : ""));
}

const KeyedPart* part_in(const std::vector<KeyedPart>& parts, const std::string& name) {
  const auto found = std::ranges::find(parts, name, &KeyedPart::name);
  return found == parts.end() ? nullptr : &*found;
}

[[noreturn]] void refuse_unset(const Thing& thing, const std::string& part) {
  throw Failure("has no " + part + " yet", thing.name,
                "set it: mars animate FILM pose " + thing.name + " " + part + "=NUMBER");
}

}  // namespace

const KeyedPart& Thing::part(const std::string& wanted) const {
  const KeyedPart* const found = part_in(parts, wanted) ? part_in(parts, wanted) : part_in(unset, wanted);
  check(found != nullptr, "a thing has the part it was asked for");
  return *found;
}

bool Thing::can_get(const std::string& wanted) const { return part_in(unset, wanted) != nullptr; }

std::vector<KeyedPart> camera_parts(const Film& film) {
  std::vector<KeyedPart> parts;
  for_each_channel(film.camera, film.color,
                   [&](const keys::Key& key, const auto& channel) { parts.push_back(keyed_part(key, film, channel)); });
  return parts;
}

std::vector<KeyedPart> light_parts(const LightMotion& light) {
  std::vector<KeyedPart> parts;
  for_each_channel(light,
                   [&](const keys::Key& key, const auto& channel) { parts.push_back(keyed_part(key, channel)); });
  return parts;
}

bool is_pattern(const Thing& thing, const std::string& name) {
  return name.find_first_of("*?[") != std::string::npos &&
         std::ranges::none_of(thing.parts,
                              [&](const KeyedPart& part) { return part.name == name || part.name == "/" + name; });
}

std::vector<std::string> parts_named(const Thing& thing, const std::string& name) {
  if (is_pattern(thing, name)) {
    std::vector<std::string> like = parts_that_change(thing);
    std::erase_if(like, [&](const std::string& part) {
      return fnmatch(name.c_str(), part.c_str(), 0) != 0 && fnmatch(name.c_str(), shown_part(part).c_str(), 0) != 0;
    });
    if (like.empty()) refuse_pattern(thing, name);
    return like;
  }
  for (const std::string& candidate : {name, "/" + name})
    for (const KeyedPart& part : thing.parts)
      if (part.name == candidate) return {part.name};
  if (thing.can_get(name)) refuse_unset(thing, name);
  std::vector<std::string> names;
  for (const KeyedPart& part : thing.parts) names.push_back(shown_part(part.name));
  for (const KeyedPart& part : thing.unset) names.push_back(part.name);
  throw Failure("has no part '" + name + "'", thing.name,
                document::did_you_mean(name, std::vector<std::string_view>(names.begin(), names.end()),
                                       thing.actor ? "its parts are place, turn and the joints of its model"
                                                   : "its parts are: " + document::joined(names)));
}

std::vector<Chosen> choose(document::Json& film, const Film& meaning, const Choice& choice) {
  if (choice.all) return everything(film, meaning);
  Chosen one = whole(thing_named(film, meaning, choice.thing));
  if (choice.parts.empty()) return {std::move(one)};
  one.parts.clear();
  for (const std::string& typed : choice.parts)
    for (const std::string& name : parts_named(one.thing, typed))
      if (std::ranges::find(one.parts, name) == one.parts.end()) one.parts.push_back(name);
  return {std::move(one)};
}

}  // namespace mars::animator
