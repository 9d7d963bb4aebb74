#include "host/studio/project/model_work.h"

#include <algorithm>
#include <utility>

#include "host/content/animator/angles.h"
#include "host/content/modeler/model_file.h"
#include "host/studio/project/describe.h"
#include "host/studio/project/film_gesture.h"
#include "host/studio/project/model_film.h"
#include "host/studio/project/model_steps.h"
#include "host/studio/project/same_shapes.h"

namespace mars::studio {
namespace {

// Which no model's file has; null: it is another step.
const FigureStep* only_poses(const Step& step) {
  const auto* const figure = std::get_if<FigureStep>(&step);
  return figure && !figure->place && !figure->turn ? figure : nullptr;
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

std::string ModelWork::text_after(const Step& step, std::uint32_t, animator::Remarks& remarks) {
  Json json = json_;
  remarks = change_model(json, model(), step);
  return document::laid_out(json);
}

bool ModelWork::kept_in_memory(const Step& step) {
  const FigureStep* const pose = only_poses(step);
  if (!pose) return false;
  for (const auto& [joint, turns] : pose->poses) joint_named(model(), joint);
  for (const auto& [joint, turns] : pose->poses) poses_[joint] = turns;
  apply_poses(pose->poses);
  return true;
}

void ModelWork::apply_poses(const std::map<std::string, glm::dvec3>& poses) {
  const modeler::Model& shown = film_.models[kModelActor];
  for (std::size_t joint = 0; joint < shown.joints.size(); ++joint)
    if (const auto pose = poses.find(shown.joints[joint].name); pose != poses.end())
      film_.actors[kModelActor].motion.pose[joint] =
          animator::constant(animator::clamped(shown.joints[joint], pose->second));
}

void ModelWork::show_pose(const FigureStep& step) {
  for (const auto& [joint, turns] : step.poses) joint_named(model(), joint);
  take_back();
  shows_ = true;
  apply_poses(step.poses);
}

void ModelWork::show(const Step& step, std::uint32_t) {
  if (const FigureStep* const pose = only_poses(step)) return show_pose(*pose);
  Json json = json_;
  change_model(json, model(), step);
  const document::Document document(json.dump(), path_.string());
  modeler::Model changed = modeler::read_own_model(document.root());
  exchange_model(film_, changed);
  if (!before_) before_ = std::move(changed);
  shown_json_ = std::move(json);
  shows_ = true;
  apply_poses(poses_);
  take_shapes(std::holds_alternative<PointStep>(step));
}

void ModelWork::take_back() {
  if (!shows_) return;
  shows_ = false;
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
  return modeler::control_points(before_ ? shown_json_ : json_, film_.models[kModelActor], joint);
}

void ModelWork::describe(Json& project, std::uint32_t frame) const {
  describe_model(project, film_, before_ ? shown_json_ : json_, frame);
}

}  // namespace mars::studio
