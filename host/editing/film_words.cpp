#include <memory>
#include <optional>

#include "host/content/animator/settings/beside.h"
#include "host/content/animator/settings/cast.h"
#include "host/content/animator/settings/film_settings.h"
#include "host/content/animator/listing/film_summary.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/document/document.h"
#include "host/content/document/text.h"
#include "host/content/modeler/figure_library.h"
#include "host/editing/film_length.h"
#include "host/editing/key_words.h"
#include "host/editing/words.h"
#include "host/cli/wrapped.h"
#include "node/wire/film.h"

namespace mars::editing {
namespace {

using document::Json;

constexpr const char* kNewFilmExample = R"(A film from nothing:
  mars film play.json new size=640,360 --figure man
  mars film play.json add floor --model floor
  mars film play.json add ball --model ball --place 1.2 -1 0.275
  mars animate play.json walk man --to 4 0 --lengthen
  mars render play.json -o play
A command changes FILM in place, or leaves it as it was. More: docs/filming.md.
)";

// What a person typed after any of the commands.
struct FilmWords {
  EditedFilm& film;
  std::string name{}, other{}, model{}, from{};
  bool lengthen = false;
  std::vector<std::string> fields{};
  std::vector<double> place{}, turn{};
  std::optional<double> height{};
  std::optional<std::uint32_t> beside{};
  std::size_t number = 0;
};

using Meaning = animator::Film;

std::optional<glm::dvec3> place_of(const FilmWords& words) {
  if (words.place.empty()) return std::nullopt;
  return glm::dvec3(words.place[0], words.place[1], words.place[2]);
}

std::optional<glm::dvec3> turn_of(const FilmWords& words) {
  if (words.turn.empty()) return std::nullopt;
  if (words.turn.size() == 1) return glm::dvec3(0, 0, words.turn[0]);
  return glm::dvec3(words.turn[0], words.turn[1], words.turn[2]);
}

// As the film names it.
std::string model_of(const FilmWords& words, const Json& film) {
  return animator::is_model_file(film, words.model) ? words.film.name_of_model(words.model) : words.model;
}

void run_new(const FilmWords& words) {
  Json film = animator::new_film();
  animator::set_film(film, values_of(words.fields, keys::object("film")));
  animator::light_new_film(film, words.film.path());
  if (!words.model.empty()) animator::add_actor(film, {words.model, words.model});
  words.film.create(film);
}

// Of a film that may be in another folder.
void run_add_of_film(const FilmWords& words) {
  const film::FilmFile other = words.film.read_other(words.from);
  const auto file_name = [&](const std::string& file) {
    return words.film.name_of_model((std::filesystem::path(words.from).parent_path() / file).string());
  };
  std::string length, rates;
  words.film.change([&](Json& film, const Meaning& meaning) {
    const double from = other.film.rate, to = meaning.rate;
    const auto last = animator::add_actor_of(film, other.json, words.name, to / from, file_name);
    length = last ? fit_length(film, *last, words.lengthen) : "";
    if (last && !length.empty())
      length += ": set its frames to " + std::to_string(*last + 1) + " to see all of the keys";
    if (last && from != to)
      rates = "keys of " + document::shown(from) + " frames a second are at those of " + document::shown(to) + " now";
  });
  if (!rates.empty()) words.film.remark(rates);
  if (!length.empty() && !words.lengthen) words.film.remark(length);
}

void run_add(const FilmWords& words) {
  if (!words.from.empty()) return run_add_of_film(words);
  words.film.change([&](Json& film, const Meaning&) {
    animator::add_actor(film, {words.name, model_of(words, film), place_of(words), turn_of(words), words.height});
    if (!words.beside) return;
    const document::Document document(document::laid_out(film), words.film.path().string());
    const Meaning with_it = animator::read_film(document.root(), words.film.path().parent_path());
    animator::place_beside(film, with_it, words.name, *words.beside);
  });
}

void run_remove(const FilmWords& words) {
  words.film.change([&](Json& film, const Meaning&) { animator::remove_actor(film, words.name); });
}

void run_rename(const FilmWords& words) {
  words.film.change([&](Json& film, const Meaning&) { animator::rename_actor(film, words.name, words.other); });
}

void run_set(const FilmWords& words) {
  words.film.change(
      [&](Json& film, const Meaning&) { animator::set_film(film, values_of(words.fields, keys::object("film"))); });
}

void run_camera(const FilmWords& words) {
  words.film.change_thing("camera", [&](Json& film, const Meaning&) {
    animator::set_camera(film, values_of(words.fields, keys::object("camera")));
  });
}

void run_show(const FilmWords& words) {
  film::FilmFile file = words.film.read();
  words.film.print(animator::film_summary(file.json, file.film));
}

void run_light_add(const FilmWords& words) {
  bool own = false;
  std::size_t number = 0;
  words.film.change([&](Json& film, const Meaning& meaning) {
    own = film.contains("lights");
    number = animator::add_light(film, meaning, values_of(words.fields, keys::object("light")));
  });
  words.film.print(
      "light/" + std::to_string(number) +
      (own ? "\n"
           : ", beside those that the film was shown with: light/1 to light/" + std::to_string(number - 1) + "\n"));
}

void run_light_set(const FilmWords& words) {
  words.film.change_thing("light/" + std::to_string(words.number), [&](Json& film, const Meaning& meaning) {
    animator::set_light(film, meaning, words.number, values_of(words.fields, keys::object("light")));
  });
}

void run_light_remove(const FilmWords& words) {
  words.film.change([&](Json& film, const Meaning& meaning) { animator::remove_light(film, meaning, words.number); });
}

void run_light_rig(const FilmWords& words) { words.film.change(animator::write_rig); }

void run_material_add(const FilmWords& words) {
  words.film.change([&](Json& film, const Meaning& meaning) {
    animator::add_material(film, meaning, words.name, values_of(words.fields, keys::object("material")), words.other);
  });
}

void run_material_set(const FilmWords& words) {
  words.film.change([&](Json& film, const Meaning&) {
    animator::set_material(film, words.name, values_of(words.fields, keys::object("material")));
  });
}

void run_material_remove(const FilmWords& words) {
  words.film.change([&](Json& film, const Meaning&) { animator::remove_material(film, words.name); });
}

// A command of which `run` does the work.
cli::Command add_command(cli::Command film, const std::shared_ptr<FilmWords>& words, const char* name,
                         const char* purpose, void (*run)(const FilmWords& words)) {
  const cli::Command command = film.add_command(name, purpose);
  command.runs([words, run] { run(*words); });
  return command;
}

cli::Option add_fields(cli::Command command, FilmWords& words, std::string_view object, const std::string& example) {
  return add_key_values(command, keys::object(object), words.fields, example);
}

void add_actor_options(cli::Command command, FilmWords& words) {
  command.add("ACTOR", words.name, "Its name. Example: tom").required();
  command
      .add("--model", words.model,
           "A figure or object of the library, a model file, or a model that the film has. Example: --model man")
      .type("MODEL");
  command
      .add("--from", words.from,
           "Another film whose actor of this name, or only actor, comes with its model and its keys. Example: --from "
           "walk.json")
      .type("FILM");
  command.add_flag("--lengthen", words.lengthen,
                   "With --from: a film that ends before the keys gets the frames up to the last one. Example: "
                   "--lengthen");
  command.add("--place", words.place, "Where it stands. Example: --place 2 0 0").words(3).type("X Y Z");
  command
      .add("--turn", words.turn,
           "How it is turned: degrees about the upward axis, or about x, y and z. Example: --turn 90")
      .words(1, 3)
      .type("DEGREES");
  limit(command
            .add("--height", words.height, "Its height at rest; only for a model of the library. Example: --height 4.6")
            .type("LENGTH"),
        keys::object("proportions").key("height"));
  command
      .add("--beside", words.beside,
           "Beside all other actors, so that it stands in none of them up to a frame. Example: --beside 0")
      .type("FRAME")
      .range(0u, wire::kMostFrames);
  command.checks([&words] {
    if (words.model.empty() == words.from.empty()) throw cli::UsageError("--model", "give it, or --from");
    if (!words.from.empty() && (words.beside || words.height || !words.place.empty() || !words.turn.empty()))
      throw cli::UsageError("--from",
                            "its actor stands where its keys say: give neither --place, --turn, --beside nor --height");
    if (words.lengthen && words.from.empty()) throw cli::UsageError("--lengthen", "give it with --from");
    if (words.beside && !words.place.empty()) throw cli::UsageError("--beside", "give it, or --place");
    if (words.turn.size() == 2) throw cli::UsageError("--turn", "give one angle, or three");
  });
}

std::string library_text() {
  const auto list = [](std::span<const modeler::LibraryFigure> library) {
    std::vector<std::string> texts;
    for (const modeler::LibraryFigure& each : library)
      texts.push_back(std::string(each.name) + " (" + std::string(each.what) + ")");
    return document::joined(texts);
  };
  return "Models of the library (2.9 units are a metre):\n  " + cli::wrapped(list(modeler::figure_library()), 2) +
         "\n  " + cli::wrapped(list(modeler::object_library()), 2) + "\n";
}

void add_actors(cli::Command film, const std::shared_ptr<FilmWords>& words) {
  const cli::Command add =
      add_command(film, words, "add", "Add an actor: a figure, an object or another model", run_add);
  add_actor_options(add, *words);
  add.footer(library_text());
  cli::Command remove = add_command(film, words, "remove", "Remove an actor", run_remove);
  remove.add("ACTOR", words->name, "The actor. Example: tom").required();
  cli::Command rename = add_command(film, words, "rename", "Give an actor another name", run_rename);
  rename.add("ACTOR", words->name, "The actor. Example: tom").required();
  rename.add("NAME", words->other, "Its new name. Example: anna").required();
}

void add_settings(cli::Command film, const std::shared_ptr<FilmWords>& words) {
  const char* const example = "frames=120 size=640,360 background=0.6,0.7,0.8";
  cli::Command fresh =
      add_command(film, words, "new", "Make a film file with a camera and lights, one of which casts shadows", run_new);
  add_fields(fresh, *words, "film", example);
  fresh.add("--figure", words->model, "Also add this figure of the library, at the origin. Example: --figure man")
      .type("FIGURE");
  add_fields(add_command(film, words, "set", "Change settings of the film", run_set), *words, "film", example)
      .required();
  add_fields(add_command(film, words, "camera", "Change the camera, the same at all frames", run_camera), *words,
             "camera", "fov=30 near=0.5 far=500")
      .required();
  add_command(film, words, "show", "List what the film contains, by the names that commands accept", run_show);
}

void add_lights(cli::Command film, const std::shared_ptr<FilmWords>& words) {
  cli::Command light = film.add_command("light", "Add, change and remove lights");
  add_fields(add_command(light, words, "add", "Add a light", run_light_add), *words, "light",
             "place=4,-3,6 at=0,0,2 color=1,0.9,0.8 intensity=2")
      .required();
  const auto add_numbered = [&](const char* name, const char* purpose, void (*run)(const FilmWords&)) {
    cli::Command command = add_command(light, words, name, purpose, run);
    command.add("N", words->number, "Its number, from 1. Example: 2").required();
    return command;
  };
  add_fields(add_numbered("set", "Change a light, the same at all frames", run_light_set), *words, "light",
             "intensity=2 color=1,0.9,0.8")
      .required();
  add_numbered("remove", "Remove a light", run_light_remove);
  add_command(light, words, "rig", "Write the three default lights into a film that has no lights of its own",
              run_light_rig);
}

void add_materials(cli::Command film, const std::shared_ptr<FilmWords>& words) {
  const char* const example = "color=0.9,0.6,0.5 reflection=blinn-phong";
  cli::Command material = film.add_command("material", "Add, change and remove materials of the film");
  const auto add = [&](const char* name, const char* purpose, void (*run)(const FilmWords&)) -> cli::Command {
    cli::Command command = add_command(material, words, name, purpose, run);
    command.add("NAME", words->name, "The material. Example: skin").required();
    return command;
  };
  cli::Command fresh = add("add", "Add a material", run_material_add);
  add_fields(fresh, *words, "material", example);
  fresh
      .add("--actor", words->other,
           "The actor that wears it: instead of its model's material of this name, which it copies at first; or, "
           "without such a material, on all segments. Example: --actor tom")
      .type("ACTOR");
  add_fields(add("set", "Change a material", run_material_set), *words, "material", example).required();
  add("remove", "Remove a material", run_material_remove);
}

}  // namespace

cli::Command add_film(cli::Command mars, EditedFilm& film) {
  const auto words = std::make_shared<FilmWords>(film);
  const cli::Command app =
      mars.add_command("film", "Begin a film; add actors, lights and materials; change its settings");
  add_settings(app, words);
  add_actors(app, words);
  add_lights(app, words);
  add_materials(app, words);
  app.footer(kNewFilmExample);  // last, or each of its commands would have it
  app.keeps(words);
  return app;
}

}  // namespace mars::editing
