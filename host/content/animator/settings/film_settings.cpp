#include "host/content/animator/settings/film_settings.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/animator/reading/read_lights.h"
#include "host/content/animator/reading/rig.h"
#include "host/content/animator/keys/written.h"
#include "host/content/document/fields.h"
#include "host/content/modeler/edit_material.h"
#include "host/content/modeler/material.h"

namespace mars::animator {
namespace {

using document::Json;

constexpr std::string_view kBelowSettings[] = {"camera", "lights", "materials", "models", "actors"};
constexpr std::string_view kBelowOwnSettings[] = {"keys"};
constexpr std::string_view kBelowAmbient[] = {"lights", "materials", "models", "actors"};
constexpr std::string_view kBelowLights[] = {"materials", "models", "actors"};
constexpr std::string_view kBelowMaterials[] = {"models", "actors"};

Json light_of(const LightMotion& light) {
  return {{"direction", written(rounded(light.vector.front().value))},
          {"color", written(light.color.front().value)},
          {"intensity", written(light.intensity.front().value)}};
}

// The film's own, which have the light of this number.
Json& lights_with(Json& film, const Film& meaning, std::size_t number) {
  if (!film.contains("lights"))
    throw Failure("has no lights of its own: those it is shown with stand in no file", meaning.source,
                  "write them into the film: mars film FILM light rig");
  Json& lights = film["lights"];
  if (number < 1 || number > lights.size())
    throw Failure("has no light " + std::to_string(number), meaning.source,
                  lights.empty() ? "it has none" : "its lights are 1 to " + std::to_string(lights.size()));
  return lights;
}

Json& material_named(Json& film, const std::string& name) {
  if (film.contains("materials") && film["materials"].contains(name)) return film["materials"][name];
  std::vector<std::string_view> names;
  if (film.contains("materials"))
    for (const auto& item : film["materials"].items()) names.push_back(item.key());
  throw Failure("is no material of the film", document::in_quotes(name),
                document::did_you_mean(name, names, "mars film FILM material add makes one"));
}

// As a file writes what shades so: without what is the default.
Json material_of(const wire::Material& material) {
  const auto number = [](float value) { return written(document::rounded_to(value, 6)); };
  Json json = {{"color", {number(material.color[0]), number(material.color[1]), number(material.color[2])}}};
  if (material.reflection != modeler::default_material().reflection)
    json["reflection"] = modeler::word_of(material.reflection);
  if (material.interpolation != modeler::default_material().interpolation)
    json["interpolation"] = modeler::word_of(material.interpolation);
  for (const modeler::MaterialNumber& each : modeler::kMaterialNumbers)
    if (uses(material.reflection, each) && material.*each.member != modeler::default_material().*each.member)
      json[std::string(each.key.name)] = number(material.*each.member);
  if (material.sides != modeler::default_material().sides) json["sides"] = material.sides;
  for (const modeler::MaterialFlag& flag : modeler::kMaterialFlags)
    if (material.*flag.member != modeler::default_material().*flag.member)
      json[std::string(flag.key.name)] = material.*flag.member != 0;
  return json;
}

// As object[key] = value; a new key stands before those in `others` that are there.
void put_before(Json& object, const std::string& key, Json value, std::span<const std::string_view> others) {
  if (object.contains(key)) return void(object[key] = std::move(value));
  Json ordered = Json::object();
  for (const auto& [name, item] : object.items()) {
    if (!ordered.contains(key) && std::ranges::find(others, std::string_view(name)) != others.end())
      ordered[key] = value;
    ordered[name] = item;
  }
  ordered[key] = std::move(value);
  object = std::move(ordered);
}

bool segments_wear(const modeler::Model& model, const std::string& material) {
  return std::ranges::any_of(
      model.joints, [&](const modeler::Joint& joint) { return joint.segment && joint.segment->material == material; });
}

// What the actor is to wear begins as what its model wears by that name.
Json put_on(Json& film, const Film& meaning, const std::string& name, const std::string& actor) {
  Json& object = actor_of(film, actor);
  const auto found = std::ranges::find(meaning.actors, actor, &Actor::name);
  const modeler::Model& model = meaning.models[found->model];
  if (!segments_wear(model, name)) {
    object["material"] = name;
    return Json::object();
  }
  object["materials"][name] = name;
  for (const modeler::NamedMaterial& own : model.materials)
    if (own.name == name) return material_of(own.material);
  return Json::object();
}

void take_off(Json& actor, const std::string& material) {
  if (actor.value("material", "") == material) actor.erase("material");
  if (!actor.contains("materials")) return;
  Json left = Json::object();
  for (const auto& [instead_of, worn] : actor["materials"].items())
    if (worn != material) left[instead_of] = worn;
  left.empty() ? void(actor.erase("materials")) : void(actor["materials"] = std::move(left));
}

void put_settings(Json& object, const Json& settings, std::span<const std::string_view> below) {
  for (const auto& [key, value] : settings.items()) put_before(object, key, value, below);
}

}  // namespace

Json new_film() {
  return {{"frames", 48},
          {"rate", 24},
          {"size", {960, 540}},
          {"background", {0.65, 0.76, 0.86}},
          {"camera", {{"eye", {14, -8, 4.5}}, {"at", {0, 0, 2.3}}, {"fov", 30}}},
          {"actors", Json::array()},
          {"models", Json::object()}};
}

void set_film(Json& film, const Json& settings) { put_settings(film, settings, kBelowSettings); }

void set_camera(Json& film, const Json& settings) { put_settings(film.at("camera"), settings, kBelowOwnSettings); }

void write_rig(Json& film, const Film& meaning) {
  if (film.contains("lights") && !film["lights"].empty())
    throw Failure("has lights of its own", meaning.source, "remove them first: mars film FILM light remove N");
  Json lights = Json::array();
  for (const LightMotion& light : rig_lights(meaning)) lights.push_back(light_of(light));
  put_before(film, "lights", std::move(lights), kBelowLights);
  if (film.contains("ambient") || meaning.color == wire::ColorSpace::coded) return;
  const Ambient ambient = rig_ambient(meaning.color);
  put_before(film, "ambient", {{"sky", written(ambient.sky)}, {"ground", written(ambient.ground)}}, kBelowAmbient);
}

void light_new_film(Json& film, const std::filesystem::path& path) {
  const document::Document document(document::laid_out(film), path.string());
  write_rig(film, read_film(document.root(), path.parent_path()));
  film["lights"][0]["shadow"] = true;
}

std::size_t add_light(Json& film, const Film& meaning, const Json& light) {
  if (!film.contains("lights")) write_rig(film, meaning);
  film["lights"].push_back(light);
  return film["lights"].size();
}

void set_light(Json& film, const Film& meaning, std::size_t number, const Json& settings) {
  put_settings(lights_with(film, meaning, number)[number - 1], settings, kBelowOwnSettings);
}

void remove_light(Json& film, const Film& meaning, std::size_t number) {
  lights_with(film, meaning, number).erase(number - 1);
}

void add_material(Json& film, const Film& meaning, const std::string& name, const Json& values,
                  const std::string& actor) {
  if (film.contains("materials") && film["materials"].contains(name))
    throw Failure("is a material of the film already", document::in_quotes(name),
                  "change it: mars film FILM material set");
  Json material = actor.empty() ? Json::object() : put_on(film, meaning, name, actor);
  modeler::change_material(material, values);
  Json materials = film.value("materials", Json::object());
  materials[name] = std::move(material);
  put_before(film, "materials", std::move(materials), kBelowMaterials);
}

void set_material(Json& film, const std::string& name, const Json& values) {
  modeler::change_material(material_named(film, name), values);
}

void remove_material(Json& film, const std::string& name) {
  material_named(film, name);
  for (Json& actor : film.at("actors")) take_off(actor, name);
  film["materials"].erase(name);
}

}  // namespace mars::animator
