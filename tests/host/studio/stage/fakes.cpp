#include "tests/host/studio/stage/fakes.h"

#include <algorithm>
#include <filesystem>

#include "hal/failure/failure.h"
#include "host/content/animator/read_film.h"
#include "host/content/modeler/read_model.h"
#include "host/preview/viewpoint.h"
#include "host/studio/project/film_gesture.h"

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
  if (step.contains("commands")) return;  // of the film's text, which it has not
  if (const std::string what = step.at("set"); what == "figure" || what == "camera" || what == "light") {
    const auto show = [&](const auto& each) {
      if constexpr (requires { FilmGesture().show(film_, rig_lights_, each, frame_); })
        FilmGesture().show(film_, rig_lights_, each, frame_);
    };
    return std::visit(show, read_step(step));
  }
  animator::Actor* actor = &film_.actors.at(0);
  if (!model_)
    for (animator::Actor& each : film_.actors)
      if (each.name == step.at("actor").get<std::string>()) actor = &each;
  modeler::Model& model = film_.models[actor->model];
  std::size_t joint = 0;
  while (step.contains("joint") && model.joints.at(joint).name != step["joint"].get<std::string>()) ++joint;
  const std::string what = step.at("set").get<std::string>();
  if (what == "pose") {
    const glm::dvec3 pose = vector_of(step.at("pose"));
    if (const auto broken = animator::broken_limit(model.joints[joint], pose)) throw Failure(*broken, "", "");
    set_key(actor->motion.pose[joint], frame_, pose);
  } else if (what == "place") {
    set_key(actor->motion.place, frame_, vector_of(step.at("place")));
  } else if (what == "turn") {
    set_key(actor->motion.turn, frame_, vector_of(step.at("turn")));
  } else if (what == "joint") {
    const Json& change = step.at("change");
    if (change.contains("place")) model.joints[joint].place = vector_of(change["place"]);
    if (change.contains("sbb"))
      model.joints[joint].segment->sbb = {vector_of(change["sbb"][0]), vector_of(change["sbb"][1])};
  } else if (what == "point") {
    const std::size_t shape = model.joints[joint].segment->shape;
    const glm::dvec3 to = vector_of(step.at("to"));
    model.shapes[shape]
        .patches.at(step.at("patch"))
        .points[4 * step.at("point")[1].get<std::size_t>() + step["point"][0].get<std::size_t>()] = {
        float(to.x), float(to.y), float(to.z)};
    pulled_ = Pulled{actor->model, shape};
  } else {
    throw Failure("is '" + what + "'", "set", "");
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
  for (auto each = told.rbegin(); each != told.rend(); ++each)
    if (each->second.at("is") == kind) return each->second;
  return {};
}

// Of the handles told or sent last.
std::vector<Json> OnStage::shapes(const std::string& id) const {
  const Json told_last = last("handles");
  const Json& all = told_last.is_object() ? told_last["shapes"] : pictures.back().handles;
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
