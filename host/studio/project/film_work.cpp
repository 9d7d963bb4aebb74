#include "host/studio/project/film_work.h"

#include <array>
#include <sstream>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/animator/pose.h"
#include "host/content/animator/read_film.h"
#include "host/content/film/compile.h"
#include "host/studio/project/describe.h"
#include "host/studio/project/same_shapes.h"

namespace mars::studio {
namespace {

using animator::PartSetting;

PartSetting setting_of(const std::string& part, const glm::dvec3& value) { return {part, {value.x, value.y, value.z}}; }

animator::Remarks change(Json& json, const animator::Film& film, const std::string& thing,
                         const std::vector<PartSetting>& settings, std::uint32_t frame) {
  return animator::pose(json, film, thing, settings, frame, std::nullopt, animator::Beyond::clamped);
}

animator::Remarks apply(Json& json, const animator::Film& film, const FigureStep& step, std::uint32_t frame) {
  const std::size_t number = actor_named(film, step.actor);
  const animator::Actor& actor = film.actors[number];
  if (step.place || step.turn) refuse_carried(film, number, frame);
  std::vector<PartSetting> settings;
  if (step.place) settings.push_back(setting_of("place", *step.place));
  if (step.turn) settings.push_back(setting_of("turn", *step.turn));
  for (const auto& [name, pose] : step.poses) {
    joint_named(film.models[actor.model], name);
    settings.push_back(setting_of("/" + name, pose));
  }
  return change(json, film, actor.name, settings, frame);
}

animator::Remarks apply(Json& json, const animator::Film& film, const CameraStep& step, std::uint32_t frame) {
  std::vector<PartSetting> settings;
  if (step.eye) settings.push_back(setting_of("eye", *step.eye));
  if (step.at) settings.push_back(setting_of("at", *step.at));
  if (step.fov) settings.push_back({"fov", {*step.fov, {}, {}}});
  return change(json, film, "camera", settings, frame);
}

animator::Remarks apply(Json& json, const animator::Film& film, const LightStep& step, std::uint32_t frame) {
  check_light(film, !json.contains("lights"), step);
  std::vector<PartSetting> settings;
  if (step.place) settings.push_back(setting_of("place", *step.place));
  if (step.at) settings.push_back(setting_of("at", *step.at));
  if (step.direction) settings.push_back(setting_of("direction", *step.direction));
  if (step.color) settings.push_back(setting_of("color", *step.color));
  if (step.intensity) settings.push_back({"intensity", {*step.intensity, {}, {}}});
  if (step.cone) settings.push_back({"cone", {step.cone->x, step.cone->y, {}}});
  if (step.reach) settings.push_back({"reach", {*step.reach, {}, {}}});
  return change(json, film, "light/" + std::to_string(step.light), settings, frame);
}

[[noreturn]] void refuse_model_step(const std::filesystem::path& path) {
  throw Failure("changes a model, but a film is open: poses, places and the camera can be changed", path.string(),
                "open the model itself: mars studio MODEL");
}

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

// None: it is a step of another kind.
std::optional<std::vector<editing::Command>> commands_of(const Step& step, const std::filesystem::path& folder) {
  if (const auto* const commands = std::get_if<CommandsStep>(&step)) return commands->commands;
  const auto* const script = std::get_if<ScriptStep>(&step);
  if (!script) return std::nullopt;
  return {{{"animate", "script", (folder / script->name).string(), "--lengthen"}}};
}

animator::Remarks remarks_of(const editing::Done& done) {
  animator::Remarks remarks = done.remarks;
  std::istringstream report(done.report);
  for (std::string line; std::getline(report, line);) remarks.push_back(line);
  return remarks;
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
    film::check_camera(prepared_->film);
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

// Null: of another kind of step.
std::unique_ptr<editing::FilmInMemory> FilmWork::edited_by(const Step& step) {
  const auto commands = commands_of(step, path_.parent_path());
  if (!commands) return nullptr;
  auto edited = std::make_unique<editing::FilmInMemory>(json_, film_, path_, folder_);
  if (const auto* const script = std::get_if<ScriptStep>(&step))
    edited->give_script(path_.parent_path() / script->name, script->text);
  edited->obey(*commands);
  return edited;
}

std::string FilmWork::text_after(const Step& step, std::uint32_t frame, animator::Remarks& remarks) {
  if (const auto edited = edited_by(step)) {
    remarks = remarks_of(edited->done());
    return document::laid_out(edited->json());
  }
  Json json = json_;
  const auto done = [&](const auto& each) {
    if constexpr (requires { apply(json, film_, each, frame); })
      remarks = apply(json, film_, each, frame);
    else
      refuse_model_step(path_);
  };
  std::visit(done, step);
  return document::laid_out(json);
}

void FilmWork::show(const Step& step, std::uint32_t frame) {
  take_back();
  if (auto edited = edited_by(step)) return show_edited(std::move(edited));
  const auto done = [&](const auto& each) {
    if constexpr (requires { gesture_.show(film_, true, each, frame); })
      gesture_.show(film_, rig_lights(), each, frame);
    else
      refuse_model_step(path_);
  };
  std::visit(done, step);
}

void FilmWork::show_edited(std::unique_ptr<editing::FilmInMemory> edited) {
  film::check_camera(edited->film());
  edited_ = std::move(edited);
  if (shows_other_shapes()) ++shapes_revision_;
}

bool FilmWork::shows_other_shapes() const { return !same_for_nodes(film_, edited_->film(), edited_->lends()); }

void FilmWork::take_back() {
  gesture_.take_back(film_);
  if (edited_ && shows_other_shapes()) ++shapes_revision_;
  edited_.reset();
}

// Of those that commands change; where they change which actors there are, all.
std::set<std::size_t> FilmWork::shown_actors() const {
  if (!edited_) return gesture_.actors();
  const Json& before = json_.at("actors");
  const Json& now = edited_->json().at("actors");
  std::set<std::size_t> changed;
  for (std::size_t actor = 0; actor < now.size(); ++actor)
    if (now.size() != before.size() || now[actor] != before[actor]) changed.insert(actor);
  return changed;
}

Json FilmWork::channels(const std::vector<std::string>& things) { return channels_of(json_, film_, things); }

Json FilmWork::curves(const CurvesWanted& wanted) {
  if (!edited_) return curves_of(json_, film_, wanted);
  Json shown = edited_->json();
  return curves_of(shown, edited_->film(), wanted);
}

void FilmWork::describe(Json& project, std::uint32_t frame) const { describe_film(project, film(), json(), frame); }

void FilmWork::describe_shown(Json& poses, std::uint32_t frame) const {
  if (edited_ || gesture_.actors().empty()) describe_camera_and_lights(poses, film(), json(), frame);
}

}  // namespace mars::studio
