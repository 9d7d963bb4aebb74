#include "host/studio/project/film_work.h"

#include <array>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/animator/reading/film_version.h"
#include "host/content/animator/keys/pose.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/film/compile.h"
#include "host/studio/project/describe.h"
#include "host/studio/project/same_shapes.h"

namespace mars::studio {
namespace {

// Two films that the same nodes' copy of shapes and segments serves. `models_same`: they are known to be.
bool same_for_nodes(const animator::Film& one, const animator::Film& two, bool models_same) {
  const auto settings = [](const animator::Film& film) {
    return std::array{film.width,
                      film.height,
                      film.samples,
                      film.dice,
                      std::uint32_t(film.color),
                      std::uint32_t(film.curve),
                      std::uint32_t(film.lights.size())};
  };
  return settings(one) == settings(two) && (models_same ? same_actors(one, two) : same_shapes(one, two));
}

[[noreturn]] void refuse_model_step(const std::filesystem::path& path) {
  throw Failure("changes a model, but a film is open: its keys, actors, lights and settings can be changed",
                path.string(), "open the model itself: mars studio MODEL");
}

}  // namespace

animator::Film FilmWork::read(const document::Element& root, bool models_stay) {
  if (models_stay) return animator::read_film(root, film_.models);
  return animator::read_film(root, path_.parent_path());
}

void FilmWork::prepare(const std::string& text, bool models_stay) {
  const document::Document document(text, path_.string());
  Json json = Json::parse(text);
  const bool lent = models_stay && json_.is_object() && json.is_object() && animator::same_models(json, json_);
  animator::Film film = read(document.root(), lent);
  prepared_ = Prepared{std::move(json), std::move(film), lent};
  try {
    film::check_camera_and_lights(prepared_->film);
  } catch (const Failure&) {
    reject();
    throw;
  }
}

void FilmWork::accept() {
  if (!same_for_nodes(film_, prepared_->film, prepared_->models_lent)) ++shapes_revision_;
  json_ = std::move(prepared_->json);
  film_ = std::move(prepared_->film);
  prepared_.reset();
}

void FilmWork::reject() {
  if (prepared_ && prepared_->models_lent) film_.models = std::move(prepared_->film.models);
  prepared_.reset();
}

void FilmWork::execute(const Step& step, For what) {
  if (const auto* const script = std::get_if<ScriptStep>(&step)) {
    const std::filesystem::path file = path_.parent_path() / script->name;
    edited_->give_script(file, script->text);
    editing::Command words{"animate", "script", file.string()};
    if (script->lengthens) words.push_back("--lengthen");
    return edited_->execute({&words, 1});
  }
  const auto* const step_of_commands = std::get_if<CommandsStep>(&step);
  if (!step_of_commands) refuse_model_step(path_);
  for (const editing::Command& command : step_of_commands->commands)
    if (command.front() == "model") refuse_model_step(path_);
  what == For::eyes ? edited_->show(step_of_commands->commands) : edited_->execute(step_of_commands->commands);
}

animator::Remarks FilmWork::show(const Step& step, For what) {
  take_back();
  edited_ = std::make_unique<editing::FilmInMemory>(json_, film_, path_, folder_);
  try {
    execute(step, what);
    film::check_camera_and_lights(film_);
  } catch (...) {
    edited_.reset();
    throw;
  }
  shown_ = step;
  if (shows_other_shapes()) ++shapes_revision_;
  return edited_->done().lines();
}

bool FilmWork::shows_other_shapes() const {
  const animator::Film* const before = edited_->film_before();
  return before && !same_for_nodes(*before, film_, edited_->models_stay());
}

void FilmWork::take_back() {
  if (!shows()) return;
  if (shows_other_shapes()) ++shapes_revision_;
  edited_.reset();
  shown_.reset();
}

void FilmWork::keep() {
  edited_->keep();
  edited_.reset();
  shown_.reset();
}

// Keys are those of the file, values those that are shown.
Json FilmWork::channels(const std::vector<std::string>& things) {
  if (!shows()) return channels_of(json_, film_, things);
  const Step again = *shown_;
  take_back();
  Json channels = channels_of(json_, film_, things);
  show(again, For::eyes);
  return channels;
}

Json FilmWork::curves(const CurvesWanted& wanted) { return curves_of(json_, film_, wanted); }

bool FilmWork::has_keys(const std::string& thing, const std::string& part) const {
  constexpr std::string_view kLight = "light/";
  if (thing == "camera") return keyed_parts(json_.at("camera")).contains(part);
  const std::size_t number = std::stoul(thing.substr(kLight.size()));
  return !rig_lights() && keyed_parts(json_.at("lights").at(number - 1)).contains(part);
}

void FilmWork::describe(Json& project, std::uint32_t frame) const { describe_film(project, film_, json_, frame); }

void FilmWork::describe_shown(Json& poses, std::uint32_t frame) const {
  if (!edited_->only_actors_changed()) describe_camera_and_lights(poses, film_, json_, frame);
}

}  // namespace mars::studio
