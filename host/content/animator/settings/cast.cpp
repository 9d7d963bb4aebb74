#include "host/content/animator/settings/cast.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/written.h"
#include "host/content/animator/settings/retime.h"
#include "host/content/document/fields.h"
#include "host/content/document/shell_word.h"
#include "host/content/keys/named_files.h"
#include "host/content/modeler/figure_library.h"

namespace mars::animator {
namespace {

using document::Json;

void refuse_taken(const Json& film, const std::string& name) {
  for (const Json& actor : film.at("actors"))
    if (actor.at("name") == name)
      throw Failure("is an actor of the film already", document::in_quotes(name), "choose another name");
  if (name == "camera") throw Failure("is the camera's name", "'camera'", "choose another name");
}

// Puts the model into the film by the first of NAME, NAME-2, ... that is free or holds the same already; that name.
std::string put_model(Json& film, const Json& model, const std::string& wanted) {
  Json& models = film["models"];
  std::string name = wanted;
  for (int number = 2; models.contains(name) && models.at(name) != model; ++number)
    name = wanted + "-" + std::to_string(number);
  models[name] = model;
  return name;
}

[[noreturn]] void refuse_model(const Json& film, const std::string& model) {
  std::vector<std::string_view> names;
  for (const auto library : {modeler::figure_library(), modeler::object_library()})
    for (const modeler::LibraryFigure& each : library) names.push_back(each.name);
  const std::string known = document::joined(names);
  for (const auto& item : film.at("models").items()) names.push_back(item.key());
  throw Failure("is no model of the film or of the library, and no model file", document::in_quotes(model),
                document::did_you_mean(model, names, "name a file like dog.json, or one of " + known));
}

// The film's name for the actor's model.
std::string model_for(Json& film, const NewActor& actor) {
  const bool file = is_model_file(film, actor.model);
  const bool known = film.at("models").contains(actor.model);
  const bool library = modeler::find_in_library(actor.model) != nullptr;
  if (library && actor.height) return put_model(film, modeler::library_figure(actor.model, actor.height), actor.name);
  if (actor.height && (known || file))
    throw Failure("has a height of its own", document::in_quotes(actor.model),
                  "leave --height out; mars model MODEL scale changes a model file");
  if (known) return actor.model;
  if (library) return put_model(film, modeler::library_figure(actor.model), actor.model);
  if (!file) refuse_model(film, actor.model);
  return put_model(film, actor.model, std::filesystem::path(actor.model).stem());
}

// Where it lies on the floor, if its frame is its middle.
std::optional<glm::dvec3> lying(const Json& film, const NewActor& actor, const std::string& model) {
  const modeler::LibraryFigure* figure = modeler::find_in_library(actor.model);
  if (figure == nullptr || !figure->centred || !film.at("models").at(model).is_object()) return std::nullopt;
  const Json& first = film.at("models").at(model).at("joints").at(0);
  return glm::dvec3(0, 0, -first.at("segment").at("sbb").at(0).at(2).get<double>());
}

// Calls take(object) for each {"actor": NAME, ...} by which the thing hangs on an actor.
void for_each_hold(Json& json, const std::function<void(Json& object)>& take) {
  if (json.is_object() && json.contains("actor") && json.at("actor").is_string()) take(json);
  if (json.is_structured())
    for (Json& item : json) for_each_hold(item, take);
}

void for_each_hold(Json& film, const std::string& on,
                   const std::function<void(const std::string& thing, Json& object)>& take) {
  const auto look = [&](const std::string& thing, Json& json) {
    for_each_hold(json, [&](Json& object) {
      if (object.at("actor") == on) take(thing, object);
    });
  };
  look("camera", film.at("camera"));
  for (Json& actor : film.at("actors"))
    for (const char* key : {"attach", "keys"})
      if (actor.contains(key)) look(actor.at("name"), actor.at(key));
}

void refuse_held(Json& film, const std::string& name) {
  std::vector<std::string> things;
  for_each_hold(film, name, [&](const std::string& thing, Json&) {
    if (thing != name && std::ranges::find(things, thing) == things.end()) things.push_back(thing);
  });
  if (things.empty()) return;
  throw Failure("is what others hang on: " + document::joined(things), "actor '" + name + "'",
                things.front() == "camera" ? "give the camera another eye and at first: mars animate FILM pose camera"
                                           : "first take away what hangs on it: mars film FILM remove " +
                                                 document::shell_word(things.front()) + ", or its keys that attach it");
}

bool used(const Json& film, const std::string& model) {
  return std::ranges::any_of(film.at("actors"), [&](const Json& actor) { return actor.at("model") == model; });
}

// Of another film, of which a person takes one actor.
const Json& actor_to_take(const Json& other, const std::string& name) {
  const Json& actors = other.at("actors");
  const auto named = std::ranges::find_if(actors, [&](const Json& actor) { return actor.at("name") == name; });
  if (named != actors.end()) return *named;
  if (actors.size() == 1) return actors.front();
  std::vector<std::string> names;
  for (const Json& actor : actors) names.push_back(actor.at("name"));
  throw Failure("is no actor of that film, which has several", document::in_quotes(name),
                "name one of them, and rename it afterwards: " + document::joined(names));
}

bool stands_elsewhere(const Json& model, const std::string& name) {
  return model.is_string() || (modeler::find_in_library(name) != nullptr && model == modeler::library_figure(name));
}

}  // namespace

bool is_model_file(const Json& film, const std::string& model) {
  const bool known = film.at("models").contains(model) || modeler::find_in_library(model) != nullptr;
  return !known && std::filesystem::path(model).extension() == ".json";
}

void add_actor(Json& film, const NewActor& actor) {
  refuse_taken(film, actor.name);
  Json changed = film;
  const std::string model = model_for(changed, actor);
  Json object = {{"name", actor.name}, {"model", model}};
  const auto place = actor.place ? actor.place : lying(changed, actor, model);
  if (place) object["place"] = written(*place);
  if (actor.turn) object["turn"] = written(*actor.turn);
  changed["actors"].push_back(std::move(object));
  film = std::move(changed);
}

std::optional<std::uint32_t> add_actor_of(Json& film, const Json& other, const std::string& name, double rates,
                                          const std::function<std::string(const std::string& file)>& file_name) {
  refuse_taken(film, name);
  Json actor = actor_to_take(other, name);
  const std::string named = actor.at("model");
  Json model = other.at("models").at(named);
  if (model.is_string())
    model = file_name(model.get<std::string>());
  else
    keys::rename_files(model, keys::object("model"), file_name);
  Json changed = film;
  actor["name"] = name;
  actor["model"] = put_model(changed, model, named);
  if (rates != 1) retime_actor(actor, rates);
  std::optional<std::uint32_t> last;
  for (const char* list : {"keys", "matrices"})
    for (const Json& key : actor.value(list, Json::array()))
      last = std::max(last.value_or(0), key.at("frame").get<std::uint32_t>());
  changed["actors"].push_back(std::move(actor));
  film = std::move(changed);
  return last;
}

void remove_actor(Json& film, const std::string& name) {
  const Json& actor = actor_of(film, name);
  refuse_held(film, name);
  const std::string model = actor.at("model");
  auto& actors = film.at("actors");
  actors.erase(actors.begin() + (&actor - &actors.front()));
  if (!used(film, model) && stands_elsewhere(film.at("models").at(model), model)) film.at("models").erase(model);
}

void rename_actor(Json& film, const std::string& name, const std::string& new_name) {
  Json& actor = actor_of(film, name);
  refuse_taken(film, new_name);
  for_each_hold(film, name, [&](const std::string&, Json& object) { object["actor"] = new_name; });
  actor["name"] = new_name;
}

}  // namespace mars::animator
