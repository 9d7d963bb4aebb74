// Every default of the table is the one that readers take: a file without the key means what a file with it does.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "host/content/animator/reading/read_film.h"
#include "host/content/document/json_file.h"
#include "host/content/film/compile.h"
#include "host/content/keys/material_keys.h"
#include "host/content/keys/shape_options.h"
#include "host/content/modeler/describe.h"
#include "host/content/modeler/shape_library.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::keys {
namespace {

using document::Json;

// Where an object of the table stands in kFilm.
const std::map<std::string_view, const char*> kPlaces{{"film", ""},
                                                      {"camera", "/camera"},
                                                      {"camera_key", "/camera/keys/0"},
                                                      {"light", "/lights/0"},
                                                      {"light_key", "/lights/1/keys/0"},
                                                      {"fog", "/fog"},
                                                      {"film_material", "/materials/plain"},
                                                      {"material_key", "/materials/keyed/keys/0"},
                                                      {"actor", "/actors/0"},
                                                      {"actor_key", "/actors/1/keys/0"},
                                                      {"point", "/camera/keys/0/eye"},
                                                      {"attach", "/actors/2/attach"},
                                                      {"joint", "/models/arm/joints/1"},
                                                      {"limits", "/models/arm/joints/1/limits"},
                                                      {"segment", "/models/arm/joints/0/segment"},
                                                      {"skin", "/models/arm/joints/3/segment/skin"},
                                                      {"bspline", "/models/arm/shapes/sail/bspline"},
                                                      {"direction", "/models/arm/shapes/sail/bspline/u"},
                                                      {"subdivision", "/models/arm/shapes/pebble/subdivision"},
                                                      {"mesh", "/models/arm/shapes/wedge/mesh"},
                                                      {"material", "/models/arm/materials/own"},
                                                      {"proportions", "/models/large/proportions"}};

constexpr const char* kFilm = R"({
  "frames": 5,
  "camera": {"keys": [{"frame": 0, "eye": {"actor": "tom", "joint": "hand", "offset": [1, -9, 2]}},
                      {"frame": 4, "eye": [2, -9, 3]}]},
  "lights": [{"place": [3, -3, 5], "at": [0, 0, 1], "shadow": true},
             {"keys": [{"frame": 0, "direction": [0, -1, 1]}, {"frame": 4, "direction": [1, -1, 1]}]}],
  "fog": {"end": 50},
  "materials": {"plain": {}, "keyed": {"keys": [{"frame": 0, "ambient": 0}, {"frame": 4, "ambient": 1}]}},
  "models": {
    "arm": {
      "joints": [{"name": "root", "place": [0, 0, 0.5], "segment": {"shape": "box", "material": "own"}},
                 {"name": "hand", "parent": "root", "place": [0.5, -2, 1], "limits": {"y": [-10, 80]},
                  "segment": {"shape": "sail", "material": "plain"}},
                 {"name": "tip", "parent": "hand", "segment": {"shape": "wedge", "material": "keyed"}},
                 {"name": "web", "parent": "tip", "segment": {"shape": "web", "skin": {"joints": ["root", "hand"]}}},
                 {"name": "stone", "segment": {"shape": "pebble"}}],
      "shapes": {
        "sail": {"bspline": {"points": [
          [[0, 0, 0], [0.3, 0.2, 0], [0.6, 0, 0.1], [0.8, 0.3, 0], [1, 0, 0]],
          [[0, 0, 0.3], [0.3, 1, 0.3], [0.6, 0, 0.3], [0.8, 0.3, 0.4], [1, 0, 0.3]],
          [[0, 0, 0.5], [0.3, 0.2, 0.6], [0.6, 0, 0.6], [0.8, 0.3, 0.5], [1, 0, 0.7]],
          [[0, 0, 1], [0.3, 0.4, 1], [0.6, 0, 1], [0.8, 0.3, 1], [1, 0, 1]]], "u": {}}},
        "pebble": {"subdivision": {"points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
                                   "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]}},
        "web": {"mesh": {"vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0.2]], "faces": [[0, 1, 2]],
                         "bones": [[0, 1], [0, 1, 1, 1], [1, 1]]}},
        "wedge": {"mesh": {"vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0.2], [0, 1, 0.9]], "faces": [[0, 1, 2], [0, 2, 3]]}}},
      "materials": {"own": {}}},
    "large": {"from": "arm.json", "proportions": {"height": 7}}},
  "actors": [
    {"name": "tom", "model": "arm", "pose": {"root": [0, 30, 0]}},
    {"name": "ann", "model": "arm", "keys": [{"frame": 0, "place": [0, 0, 0]}, {"frame": 4, "place": [1, 0, 0]}]},
    {"name": "tim", "model": "large", "attach": {"actor": "tom"}}]
})";

// All that a reader made of the film, as text; or its failure. The film's files are written into `folder`.
std::string meaning_of(const Json& json, const std::filesystem::path& folder) {
  std::string meaning;
  const std::string failure = document::failure_of([&] {
    std::ofstream(folder / "arm.json") << json["models"]["arm"];
    const document::Document document(json.dump(), (folder / "film.json").string());
    const animator::Film film = animator::read_film(document.root(), folder);
    const bool is_pair = film.camera.projection == wire::Projection::perspective;
    for (const film::Eye eye : {film::Eye::middle, is_pair ? film::Eye::left : film::Eye::middle}) {
      const film::CompiledFilm compiled = film::compile(film, {.eye = eye});
      meaning.append(reinterpret_cast<const char*>(compiled.block().data()), compiled.block().size());
    }
    for (const modeler::Model& model : film.models) meaning += modeler::describe_model(model);
  });
  return failure.empty() ? meaning : failure;
}

Json default_value(const Key& key) {
  if (key.number) return *key.number;
  return key.json.empty() ? Json() : Json::parse(key.json);
}

bool has_default(const Object& object, const Key& key) {
  const bool of_keys = object.name.ends_with("_key");  // where only `ease` has one
  const bool of_videos = key.name == "audio_delay";    // which no frame shows
  return (key.number || !key.json.empty()) && (!of_keys || key.name == "ease") && !of_videos;
}

// Another value than the default; null where none is known.
Json other_value(const Key& key) {
  if (!key.choices.empty()) return key.choices[0] == default_value(key) ? key.choices[1] : key.choices[0];
  if (key.type == "flag") return key.json != "true";
  if (key.type == "whole") return *key.number == key.range.lowest ? *key.number + 1 : *key.number - 1;
  if (key.number) return *key.number + std::min(100.0, key.range.highest - *key.number) / 2;
  const Json example = key.example.empty() ? Json() : Json::parse(key.example);
  return example == default_value(key) ? Json() : example;
}

// As the key can stand there: a number with a reflection that uses it, an option with its shape, the height of a camera
// that has one.
void make_room(std::string_view name, const Key& key, Json& object) {
  for (const MaterialNumber& number : kMaterialNumbers)
    for (unsigned i = 0; number.key.name == key.name && i < std::size(kReflections); ++i)
      if (uses(static_cast<wire::Reflection>(i), number)) object["reflection"] = kReflections[i];
  if (name == "camera" && key.name == "height") object["projection"] = "orthographic";
  for (const modeler::LibraryShape& shape : modeler::shape_library())
    if (name == "segment" && shape.option != nullptr && shape.option->name == key.name) object["shape"] = shape.name;
}

void expect_default(const Object& object, const Key& key, const std::filesystem::path& folder) {
  Json film = Json::parse(kFilm);
  Json& place = film[Json::json_pointer(kPlaces.at(object.name))];
  make_room(object.name, key, place);
  const std::string name(key.name);
  place.erase(name);
  const std::string left_out = meaning_of(film, folder);
  EXPECT_FALSE(left_out.starts_with(folder.string())) << left_out.substr(0, 300);
  place[name] = default_value(key);
  EXPECT_TRUE(meaning_of(film, folder) == left_out) << meaning_of(film, folder).substr(0, 300);
  place[name] = other_value(key);
  if (!place[name].is_null()) EXPECT_FALSE(meaning_of(film, folder) == left_out) << "another value means the same";
}

TEST(Defaults, OfTheTableAreThoseOfReaders) {
  const test::TemporaryFolder folder;
  for (const auto objects : {film_objects(), model_objects()})
    for (const Object& object : objects)
      for (const Key& key : object.keys) {
        if (!has_default(object, key)) continue;
        SCOPED_TRACE(std::string(object.name) + "." + std::string(key.name));
        ASSERT_TRUE(kPlaces.contains(object.name)) << "say where such an object stands in the film of this test";
        expect_default(object, key, folder.path());
      }
}

}  // namespace
}  // namespace mars::keys
