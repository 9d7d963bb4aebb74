#include "host/studio/project/film_work.h"

#include <array>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/animator/film_version.h"
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

// Two films that the same nodes' copy of shapes and segments serves.
bool same_for_nodes(const animator::Film& one, const animator::Film& two) {
  const auto settings = [](const animator::Film& film) {
    return std::array{film.frames,
                      film.width,
                      film.height,
                      film.samples,
                      film.dice,
                      std::uint32_t(film.color),
                      std::uint32_t(film.curve),
                      std::uint32_t(film.lights.size())};
  };
  return settings(one) == settings(two) && same_shapes(one, two);
}

}  // namespace

animator::Film FilmWork::read(const document::Element& root, bool models_stay) {
  if (models_stay) return animator::read_film(root, film_.models);
  return animator::read_film(root, path_.parent_path());
}

void FilmWork::prepare(const std::string& text, bool models_stay) {
  const document::Document document(text, path_.string());
  Json json = Json::parse(text);
  const auto same = [&](const char* key) { return json.value(key, Json()) == json_.value(key, Json()); };
  const bool lent = models_stay && json_.is_object() && json.is_object() && same("models") && same("materials");
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
  if (!prepared_->models_lent && !same_for_nodes(film_, prepared_->film)) ++shapes_revision_;
  json_ = std::move(prepared_->json);
  film_ = std::move(prepared_->film);
  prepared_.reset();
}

void FilmWork::reject() {
  if (prepared_ && prepared_->models_lent) film_.models = std::move(prepared_->film.models);
  prepared_.reset();
}

std::string FilmWork::text_after(const Step& step, std::uint32_t frame, animator::Remarks& remarks) const {
  Json json = json_;
  const auto done = [&](const auto& each) {
    if constexpr (requires { apply(json, film_, each, frame); })
      remarks = apply(json, film_, each, frame);
    else
      refuse_model_step(path_);
  };
  std::visit(done, step);
  animator::write_version(json);
  return document::laid_out(json);
}

void FilmWork::show(const Step& step, std::uint32_t frame) {
  const auto done = [&](const auto& each) {
    if constexpr (requires { gesture_.show(film_, true, each, frame); })
      gesture_.show(film_, rig_lights(), each, frame);
    else
      refuse_model_step(path_);
  };
  std::visit(done, step);
}

void FilmWork::describe(Json& project, std::uint32_t frame) const { describe_film(project, film_, json_, frame); }

void FilmWork::describe_shown(Json& poses, std::uint32_t frame) const {
  if (gesture_.actors().empty()) describe_camera_and_lights(poses, film_, json_, frame);
}

}  // namespace mars::studio
