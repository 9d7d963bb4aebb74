#include "tests/host/studio/stage/fakes.h"

#include <algorithm>
#include <filesystem>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/angles.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/animator/reading/rig.h"
#include "host/content/animator/keys/set_key.h"
#include "host/content/modeler/read_model.h"
#include "host/preview/viewpoint.h"
#include "tests/host/studio/step_words.h"

namespace mars::studio {
namespace {

glm::dvec3 vector_of(const Json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

void set_key(animator::Channel<glm::dvec3>& channel, std::uint32_t frame, const glm::dvec3& value) {
  for (auto& key : channel)
    if (key.frame == frame) {
      key.value = value;
      return;
    }
  const auto after = std::find_if(channel.begin(), channel.end(), [&](const auto& key) { return key.frame > frame; });
  channel.insert(after, {frame, value, animator::kLinear});
}

}  // namespace

void FakeProject::apply(const Json& step) {
  film_ = saved_;
  pulled_.reset();
  ++revision_;
  if (step.contains("commands") && step["commands"][0][1] != "pose" && step["commands"][0][0] != "model")
    return;  // of the film's text, which it has not
  const Json effect = effect_of(step);
  if (effect["does"] == "turn") return pose(film_.actors.at(0), effect);
  if (effect["does"] != "pose") return change_model(effect);
  const std::string thing = effect.at("of").get<std::string>();
  if (thing == "camera") return move_camera(effect);
  if (thing.starts_with("light/")) return move_light(film_.lights.at(std::stoul(thing.substr(6)) - 1), effect);
  for (animator::Actor& actor : film_.actors)
    if (actor.name == thing) pose(actor, effect);
}

void FakeProject::pose(animator::Actor& actor, const Json& effect) {
  if (effect.contains("place")) set_key(actor.motion.place, frame_, vector_of(effect["place"]));
  if (effect.contains("turn")) set_key(actor.motion.turn, frame_, vector_of(effect["turn"]));
  const modeler::Model& model = film_.models[actor.model];
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint)
    if (const auto turns = effect.find(model.joints[joint].name); turns != effect.end())
      set_key(actor.motion.pose[joint], frame_, animator::clamped(model.joints[joint], vector_of(*turns)));
}

void FakeProject::move_camera(const Json& effect) {
  const auto set_point = [&](animator::Channel<animator::Point>& points, const char* name) {
    if (effect.contains(name)) animator::set_key(points, animator::Point{vector_of(effect[name])}, frame_, {});
  };
  set_point(film_.camera.eye, "eye");
  set_point(film_.camera.at, "at");
  if (effect.contains("fov")) animator::set_key(film_.camera.fov, effect["fov"].get<double>(), frame_, 0.0);
  if (effect.contains("height")) animator::set_key(film_.camera.height, effect["height"].get<double>(), frame_, 0.0);
  if (rig_lights_) film_.lights = animator::rig_lights(film_);
}

void FakeProject::move_light(animator::LightMotion& light, const Json& effect) {
  for (const char* name : {"place", "direction"})
    if (effect.contains(name)) animator::set_key(light.vector, vector_of(effect[name]), frame_, {});
  if (effect.contains("at")) animator::set_key(light.at, vector_of(effect["at"]), frame_, {});
  if (effect.contains("reach")) animator::set_key(light.reach, effect["reach"].get<double>(), frame_, 0.0);
  if (effect.contains("cone"))
    animator::set_key(light.cone, glm::dvec2(effect["cone"][0].get<double>(), effect["cone"][1].get<double>()), frame_,
                      {});
}

void FakeProject::change_model(const Json& effect) {
  const std::size_t number = film_.actors.at(0).model;
  modeler::Model& model = film_.models[number];
  modeler::Joint& joint = *std::ranges::find(model.joints, effect.at("of").get<std::string>(), &modeler::Joint::name);
  if (effect["does"] == "point") {
    const glm::dvec3 to = vector_of(effect.at("to"));
    const std::size_t point = 4 * effect.at("at")[1].get<std::size_t>() + effect["at"][0].get<std::size_t>();
    model.shapes[joint.segment->shape].patches.at(effect.at("patch").get<std::size_t>()).points[point] = {
        float(to.x), float(to.y), float(to.z)};
    pulled_ = Pulled{number, joint.segment->shape};
    return;
  }
  if (effect.contains("place")) joint.place = vector_of(effect["place"]);
  if (!effect.contains("sbb")) return;
  for (int axis = 0; axis < 3; ++axis) {
    joint.segment->sbb.min[axis] = effect["sbb"][axis].get<double>();
    joint.segment->sbb.max[axis] = effect["sbb"][3 + axis].get<double>();
  }
}

void FakeProject::preview(const Json& step) {
  previews.push_back(step);
  apply(step);
  in_gesture_ = true;
}

void FakeProject::commit(const Json& step) {
  commits.push_back(step);
  apply(step);
  saved_ = film_;
  if (pulled_) ++shapes_revision_;
  pulled_.reset();
  in_gesture_ = false;
}

void FakeProject::cancel() {
  ++cancels;
  film_ = saved_;
  pulled_.reset();
  in_gesture_ = false;
  ++revision_;
}

void FakeProject::change(const std::function<void(animator::Film&)>& change, bool shapes) {
  change(saved_);
  film_ = saved_;
  ++revision_;
  if (shapes) ++shapes_revision_;
}

void OnStage::view(int number, int width, int height, const std::string& from, const std::string& as,
                   const std::string& more) {
  sizes[static_cast<std::uint32_t>(number)] = {width, height};
  take("{\"do\": \"view\", \"view\": " + std::to_string(number) + ", \"width\": " + std::to_string(width) +
       ", \"height\": " + std::to_string(height) + ", \"from\": \"" + from + "\", \"as\": \"" + as + "\"" + more + "}");
}

void OnStage::answer(const FakeLink::Asked& asked, std::uint32_t width, std::uint32_t height) {
  SurfacePicture picture;
  picture.view = asked.view;
  picture.picture = asked.picture;
  picture.head.width = width;
  picture.head.height = height;
  picture.head.rects = 1;
  picture.rects = {{0, 0, 1, 1}};
  picture.pixels = {0xff000000u};
  stage->take_surface(std::move(picture));
}

void OnStage::answer() {
  const FakeLink::Asked asked = link.asked.back();
  answer(asked, sizes.at(asked.view).first, sizes.at(asked.view).second);
}

void OnStage::paint() {
  std::map<std::uint32_t, std::uint32_t> newest;
  for (const ViewPicture& picture : pictures) newest[picture.view] = picture.picture;
  for (const auto& [view, picture] : newest)
    take("{\"do\": \"painted\", \"view\": " + std::to_string(view) + ", \"picture\": " + std::to_string(picture) + "}");
}

Json OnStage::last(const std::string& kind) const {
  for (auto each = sent.rbegin(); each != sent.rend(); ++each)
    if (each->second.at("is") == kind) return each->second;
  return {};
}

// Of the handles sent last, by themselves or with a picture.
std::vector<Json> OnStage::shapes(const std::string& id) const {
  const Json sent_last = last("handles");
  const Json& all = sent_last.is_object() ? sent_last["shapes"] : pictures.back().handles;
  std::vector<Json> found;
  for (const Json& shape : all)
    if (shape.at("id") == id) found.push_back(shape);
  return found;
}

animator::Film example(const std::string& name) {
  return animator::read_film(std::filesystem::path(MARS_SOURCE_DIR) / "examples" / name);
}

animator::Film model_film(const std::string& name) {
  const auto path = std::filesystem::path(MARS_SOURCE_DIR) / "examples/models" / name;
  animator::Film film = preview::turntable(modeler::load_model(path), path.string());
  film.frames = 1;
  film.camera.eye.resize(1);
  for (animator::LightMotion& light : film.lights) light.vector.resize(1);
  return film;
}

}  // namespace mars::studio
