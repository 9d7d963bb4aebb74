#include "host/studio/project/film_gesture.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "hal/failure/failure.h"
#include "host/content/animator/angles.h"
#include "host/content/animator/attachments.h"
#include "host/content/animator/camera_points.h"
#include "host/content/animator/rig.h"
#include "host/content/animator/set_key.h"
#include "host/content/document/fields.h"

namespace mars::studio {
namespace {

template <typename Items>
[[noreturn]] void refuse_name(const std::string& name, const char* what, const Items& items) {
  std::vector<std::string_view> names;
  for (const auto& item : items) names.push_back(item.name);
  throw Failure(what, "'" + name + "'", document::did_you_mean(name, names, "choose another"));
}

template <typename Value>
void set_part(animator::Channel<Value>& channel, const std::optional<Value>& value, std::uint32_t frame) {
  if (value) animator::set_key(channel, *value, frame, {});
}

void set_light(animator::LightMotion& light, const LightStep& step, std::uint32_t frame) {
  if (step.direction) animator::set_key(light.vector, glm::normalize(*step.direction), frame, {});
  set_part(light.vector, step.place, frame);
  set_part(light.at, step.at, frame);
  set_part(light.cone, step.cone, frame);
  set_part(light.reach, step.reach, frame);
  set_part(light.color, step.color, frame);
  set_part(light.intensity, step.intensity, frame);
}

}  // namespace

std::size_t actor_named(const animator::Film& film, const std::string& name) {
  if (film.actors.empty()) throw Failure("has no actors", film.source, "add one to the film");
  const auto found = name.empty() && film.actors.size() == 1
                         ? film.actors.begin()
                         : std::ranges::find(film.actors, name, &animator::Actor::name);
  if (found == film.actors.end()) refuse_name(name, "is no actor of the film", film.actors);
  if (!found->matrices.empty())
    throw Failure("is moved by matrices, which have no keys", "actor '" + found->name + "'",
                  "change its matrices in the tool they came from");
  return static_cast<std::size_t>(found - film.actors.begin());
}

std::size_t joint_named(const modeler::Model& model, const std::string& name) {
  const auto found = std::ranges::find(model.joints, name, &modeler::Joint::name);
  if (found == model.joints.end()) refuse_name(name, "is no joint of the model", model.joints);
  return static_cast<std::size_t>(found - model.joints.begin());
}

void refuse_carried(const animator::Film& film, std::size_t actor, std::uint32_t frame) {
  const animator::Attachment* const carrier = animator::attachment_at(film.actors[actor], frame);
  if (!carrier) return;
  throw Failure("is carried by '" + film.actors[carrier->actor].name + "' at frame " + std::to_string(frame),
                "actor '" + film.actors[actor].name + "'", "detach it there, or move what carries it");
}

void check_light(const animator::Film& film, bool rig_lights, const LightStep& step) {
  const std::string name = "light " + std::to_string(step.light);
  if (rig_lights || step.light > film.lights.size())
    throw Failure("is no light of the film", name, "add it to the film's lights");
  const animator::LightMotion& light = film.lights[step.light - 1];
  const bool far = light.kind == wire::LightKind::directional;
  const auto needs = [&](bool said, bool has, const char* part) {
    if (said && !has)
      throw Failure(std::string("has no part '") + part + "'", name, "give it to the light in the film");
  };
  needs(step.place.has_value(), !far, "place");
  needs(step.direction.has_value(), far, "direction");
  needs(step.at.has_value(), !light.at.empty(), "at");
  needs(step.cone.has_value(), !light.cone.empty(), "cone");
  needs(step.reach.has_value(), !light.reach.empty(), "reach");
  if (step.direction && !(glm::length(*step.direction) > 1e-9))
    throw Failure("has no length", "the direction of " + name, "write a vector to the light");
}

void FilmGesture::set(animator::Channel<glm::dvec3>& channel, const glm::dvec3& value, std::uint32_t frame,
                      const glm::dvec3& rest) {
  vectors_.push_back({&channel, channel});
  animator::set_key(channel, value, frame, rest);
}

void FilmGesture::show(animator::Film& film, bool, const FigureStep& step, std::uint32_t frame) {
  const std::size_t number = actor_named(film, step.actor);
  animator::Actor& actor = film.actors[number];
  const modeler::Model& model = film.models[actor.model];
  for (const auto& [name, pose] : step.poses) joint_named(model, name);
  if (step.place || step.turn) refuse_carried(film, number, frame);
  take_back(film);
  if (step.place) set(actor.motion.place, *step.place, frame);
  if (step.turn) set(actor.motion.turn, *step.turn, frame);
  for (const auto& [name, pose] : step.poses) {
    const std::size_t joint = joint_named(model, name);
    set(actor.motion.pose[joint], animator::clamped(model.joints[joint], pose), frame, model.joints[joint].rest());
  }
  actors_ = {number};
  shows_ = true;
}

void FilmGesture::show(animator::Film& film, bool rig_lights, const CameraStep& step, std::uint32_t frame) {
  animator::CameraMotion& camera = film.camera;
  take_back(film);
  const auto set_point = [&](animator::Channel<animator::Point>& points, const glm::dvec3& place) {
    points_.push_back({&points, points});
    animator::set_key(points, animator::Point{place}, frame, {});
  };
  if (step.eye) set_point(camera.eye, *step.eye);
  if (step.at) set_point(camera.at, *step.at);
  if (step.fov) {
    numbers_.push_back({&camera.fov, camera.fov});
    animator::set_key(camera.fov, *step.fov, frame, 0.0);
  }
  shows_ = true;
  const glm::dvec3 ahead = animator::at_at(film, frame) - animator::eye_at(film, frame);
  const glm::dvec3 side = glm::cross(ahead, animator::value_at(camera.up, frame));
  if (glm::length(ahead) < 1e-9 || glm::length(side) < 1e-6 * glm::length(ahead)) {
    take_back(film);
    throw Failure("would see nothing", "the camera", "move its eye away from what it looks at");
  }
  if (!rig_lights) return;
  lights_ = film.lights;
  film.lights = animator::rig_lights(film);
}

void FilmGesture::show(animator::Film& film, bool rig_lights, const LightStep& step, std::uint32_t frame) {
  check_light(film, rig_lights, step);
  take_back(film);
  lights_ = film.lights;
  set_light(film.lights[step.light - 1], step, frame);
  shows_ = true;
}

void FilmGesture::take_back(animator::Film& film) {
  for (auto saved = vectors_.rbegin(); saved != vectors_.rend(); ++saved) *saved->channel = std::move(saved->was);
  for (auto& saved : numbers_) *saved.channel = std::move(saved.was);
  if (!lights_.empty()) film.lights = std::move(lights_);
  for (auto& saved : points_) *saved.channel = std::move(saved.was);
  vectors_.clear();
  points_.clear();
  numbers_.clear();
  lights_.clear();
  actors_.clear();
  shows_ = false;
}

}  // namespace mars::studio
