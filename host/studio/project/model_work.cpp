#include "host/studio/project/model_work.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/angles.h"
#include "host/content/document/fields.h"
#include "host/content/modeler/model_file.h"
#include "host/editing/model_in_memory.h"
#include "host/studio/project/describe.h"
#include "host/studio/project/model_film.h"
#include "host/studio/project/same_shapes.h"

namespace mars::studio {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw Failure(std::string("a model has no ") + what, "", "set it in a film: mars studio FILM");
}

bool pulls_points(const CommandsStep& step) {
  return std::ranges::all_of(step.commands,
                             [](const editing::Command& words) { return words.size() > 1 && words[1] == "point"; });
}

void require_joint(const modeler::Model& model, const std::string& name) {
  std::vector<std::string_view> names;
  for (const modeler::Joint& joint : model.joints) names.push_back(joint.name);
  if (std::ranges::find(names, name) == names.end())
    throw Failure("is no joint of the model", document::in_quotes(name),
                  document::did_you_mean(name, names, "choose another"));
}

}  // namespace

const modeler::Model& ModelWork::model() const { return before_ ? *before_ : film_.models[kModelActor]; }

void ModelWork::prepare(const std::string& text, bool) {
  const document::Document document(text, path_.string());
  modeler::Model model = modeler::read_own_model(document.root());
  prepared_ = Prepared{Json::parse(text), std::move(model)};
}

void ModelWork::accept() {
  json_ = std::move(prepared_->json);
  if (!film_.models.empty() && suits(film_, prepared_->model))
    exchange_model(film_, prepared_->model);
  else
    film_ = film_of_model(std::move(prepared_->model), path_.string());
  prepared_.reset();
  apply_poses(poses_);
  pulled_.reset();
  take_shapes(false);
}

void ModelWork::apply_poses(const std::map<std::string, glm::dvec3>& poses) {
  const modeler::Model& shown = film_.models[kModelActor];
  for (std::size_t joint = 0; joint < shown.joints.size(); ++joint)
    if (const auto pose = poses.find(shown.joints[joint].name); pose != poses.end())
      film_.actors[kModelActor].motion.pose[joint] =
          animator::constant(animator::clamped(shown.joints[joint], pose->second));
}

animator::Remarks ModelWork::show(const Step& step, For) {
  if (std::holds_alternative<ScriptStep>(step)) refuse("actors, whom a script could move");
  if (const auto* const commands = std::get_if<CommandsStep>(&step)) return show_commands(*commands);
  show_pose(std::get<PoseStep>(step));
  return {};
}

void ModelWork::show_pose(const PoseStep& step) {
  for (const auto& [joint, turns] : step.pose) require_joint(model(), joint);
  take_back();
  shows_ = true;
  shown_poses_ = step.pose;
  apply_poses(step.pose);
}

animator::Remarks ModelWork::show_commands(const CommandsStep& step) {
  for (const editing::Command& words : step.commands)
    if (words.front() != "model") refuse("keys, actors and lights, which this command could change");
  editing::ModelInMemory edited(json_, model(), path_, folder_);
  edited.execute(step.commands);
  modeler::Model changed = edited.model();
  exchange_model(film_, changed);
  if (!before_) before_ = std::move(changed);
  shown_json_ = edited.json();
  shows_ = true;
  apply_poses(poses_);
  take_shapes(pulls_points(step));
  return edited.done().lines();
}

void ModelWork::keep() {
  for (const auto& [joint, turns] : shown_poses_) poses_[joint] = turns;
  shown_poses_.clear();
  shows_ = false;
  if (!before_) return;
  prepared_ = Prepared{std::move(shown_json_), film_.models[kModelActor]};
  before_.reset();
  accept();
}

void ModelWork::take_back() {
  if (!shows_) return;
  shows_ = false;
  shown_poses_.clear();
  pulled_.reset();
  if (before_) {
    exchange_model(film_, *before_);
    before_.reset();
    take_shapes(false);
  }
  film_.actors[kModelActor].motion.pose.assign(film_.models[kModelActor].joints.size(), {});
  apply_poses(poses_);
}

void ModelWork::take_shapes(bool pulls) {
  const modeler::Model& now = film_.models[kModelActor];
  const bool same = same_segments(known_, now) && std::ranges::equal(known_.shapes, now.shapes, same_shape);
  if (same) return;
  const auto shape = pulls ? pulled_shape(known_, now) : std::nullopt;
  if (shape) {
    pulled_ = {kModelActor, *shape};
    return;
  }
  pulled_.reset();
  known_ = now;
  ++shapes_revision_;
}

std::vector<modeler::ControlPoint> ModelWork::control_points(const std::string& joint) const {
  return modeler::control_points(shown_json(), film_.models[kModelActor], joint);
}

void ModelWork::describe(Json& project, std::uint32_t frame) const {
  describe_model(project, film_, shown_json(), frame);
}

}  // namespace mars::studio
