#include "host/content/importer/motions/film_text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/written.h"
#include "host/content/animator/pose/figure.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/animator/settings/film_settings.h"
#include "host/content/document/document.h"
#include "host/content/elementary/elementary.h"

namespace mars::importer {
namespace {

using document::Json;

constexpr double kTurnError = 3e-6;  // radians; along a chain of joints they add up to 1e-4 of a figure's size at most
constexpr std::uint32_t kLongestWay = 1000;  // frames from a key to the next
constexpr double kMargin = 1.05, kAspect = 16.0 / 9;
constexpr double kTangent = 0.36397023;  // of half of a camera's 40 degrees
constexpr double kUsualNear = 0.2, kUsualFar = 10000;
const glm::dvec3 kToCamera(0.8, -1, 0.3);  // from what it looks at

using Values = std::vector<glm::dvec3>;  // by frame
// Whether the way from one frame's value to another's gives the frames between.
using Fits = std::function<bool(std::uint32_t from, std::uint32_t to)>;

// As few frames as it takes when each way is as long as it can be: tried at 2, 4, 8, ... frames, then between.
std::vector<std::uint32_t> key_frames(std::uint32_t frames, const Fits& fits) {
  std::vector<std::uint32_t> keys{0};
  while (keys.back() + 1 < frames) {
    const std::uint32_t from = keys.back(), farthest = std::min(frames - 1 - from, kLongestWay);
    std::uint32_t good = 1, bad = farthest + 1;
    while (good * 2 < bad && fits(from, from + good * 2)) good *= 2;
    bad = std::min(bad, good * 2);
    while (good + 1 < bad) {
      const std::uint32_t middle = (good + bad) / 2;
      (fits(from, from + middle) ? good : bad) = middle;
    }
    keys.push_back(from + good);
  }
  return keys;
}

std::vector<std::uint32_t> keys_of_places(const Values& places, double error) {
  return key_frames(static_cast<std::uint32_t>(places.size()), [&](std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t frame = from + 1; frame < to; ++frame) {
      const double part = double(frame - from) / double(to - from);
      if (glm::length(places[from] + part * (places[to] - places[from]) - places[frame]) > error) return false;
    }
    return true;
  });
}

double difference(const glm::dmat3& one, const glm::dmat3& other) {
  double greatest = 0;
  for (int column = 0; column < 3; ++column) greatest = std::max(greatest, glm::length(one[column] - other[column]));
  return greatest;
}

std::vector<std::uint32_t> keys_of_turns(const modeler::Joint& joint, const Values& poses) {
  std::vector<glm::dmat3> turns;
  for (const glm::dvec3& pose : poses) turns.push_back(modeler::orientation(joint, pose));
  return key_frames(static_cast<std::uint32_t>(poses.size()), [&](std::uint32_t from, std::uint32_t to) {
    const animator::Channel<glm::dvec3> channel{{from, poses[from]}, {to, poses[to]}};
    animator::JointMotion motion(joint, channel);
    for (std::uint32_t frame = from + 1; frame < to; ++frame)
      if (difference(motion.at(frame), turns[frame]) > kTurnError) return false;
    return true;
  });
}

bool is_still(const Values& values) {
  return std::ranges::all_of(values, [&](const glm::dvec3& value) { return value == values[0]; });
}

Json text_of(const glm::dvec3& value) { return animator::written(value); }

glm::dvec3 within(const modeler::Joint& joint, const glm::dvec3& pose) {
  glm::dvec3 nearest;
  for (int axis = 0; axis < 3; ++axis)
    nearest[axis] = std::clamp(animator::rounded(pose[axis]), joint.limits[axis].lower, joint.limits[axis].upper);
  return nearest;
}

// From the middle of a box, so that all its corners are in the picture.
double distance_to_see(const glm::dvec3& half, const glm::dvec3& toward) {
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), toward)), up = glm::cross(toward, right);
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 place(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z);
    const double across = std::max(std::abs(glm::dot(place, right)) / kAspect, std::abs(glm::dot(place, up)));
    distance = std::max(distance, glm::dot(place, toward) + kMargin * across / kTangent);
  }
  return distance;
}

}  // namespace

void KeyedText::add(const char* name, Values values, double error) {
  for (glm::dvec3& value : values) value = animator::rounded(value);
  if (is_still(values)) {
    json_[name] = text_of(values[0]);
    return;
  }
  for (const std::uint32_t frame : keys_of_places(values, error)) keys_[frame][name] = text_of(values[frame]);
}

void KeyedText::add_pose(const modeler::Joint& joint, std::span<const glm::dvec3> poses) {
  Values values;
  for (const glm::dvec3& pose : poses) values.push_back(within(joint, pose));
  if (is_still(values)) {
    if (values[0] != joint.rest()) pose_[joint.name] = text_of(values[0]);
    return;
  }
  for (const std::uint32_t frame : keys_of_turns(joint, values))
    keys_[frame]["pose"][joint.name] = text_of(values[frame]);
}

Json KeyedText::finished() const {
  Json json = json_;
  if (!pose_.empty()) json["pose"] = pose_;
  Json keys = Json::array();
  for (const auto& [frame, values] : keys_) {
    Json key{{"frame", frame}};
    key.update(values);
    keys.push_back(std::move(key));
  }
  if (!keys.empty()) json["keys"] = std::move(keys);
  return json;
}

ActorText actor_text(const std::string& name, std::span<const modeler::Joint> joints, const ActorMotion& motion,
                     double error) {
  KeyedText text({{"name", name}, {"model", name}});
  if (std::ranges::any_of(motion.places,
                          [](const glm::dvec3& place) { return animator::rounded(place) != glm::dvec3(0); }))
    text.add("place", motion.places, error);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    Values poses;
    for (const auto& pose : motion.poses) poses.push_back(pose[i]);
    text.add_pose(joints[i], poses);
  }
  return {text.finished(), text.keys()};
}

Json camera_text(const glm::dvec3& least, const glm::dvec3& greatest) {
  const glm::dvec3 middle = (least + greatest) / 2.0, half = (greatest - least) / 2.0;
  const double radius = std::max(glm::length(half), 1e-6);
  const glm::dvec3 toward = glm::normalize(kToCamera);
  const double distance = std::max(distance_to_see(half, toward), radius * 0.1);
  const auto short_text = [&](const glm::dvec3& point) {
    const double grain = elementary::pow(10, std::floor(elementary::log10(radius)) - 3);
    return text_of(animator::rounded(glm::round(point / grain) * grain));
  };
  Json json{{"eye", short_text(middle + distance * toward)}, {"at", short_text(middle)}};
  if (distance - radius < kUsualNear || distance > kUsualFar / 10) {
    json["near"] = animator::rounded(distance / 1000);
    json["far"] = animator::rounded(distance * 100);
  }
  return json;
}

document::LongText film_text(FilmText film) {
  const auto line = [](const char* key, const Json& value) {
    std::string text = document::laid_out(value);
    text.pop_back();  // its end of line
    return "  \"" + std::string(key) + "\": " + text + ",\n";
  };
  std::string text = "{\n" + line("frames", film.frames) + line("rate", document::plain_number(film.rate));
  if (film.size) text += line("size", *film.size);
  text += line("background", animator::new_film()["background"]) + line("camera", film.camera);
  if (!film.lights.is_null()) text += line("lights", film.lights);
  text += "  \"models\": {" + Json(film.model_name).dump() + ": ";
  document::LongText parts = std::move(film.model);
  parts.insert(parts.begin(), {text});
  while (parts.back().text.ends_with('\n')) parts.back().text.pop_back();
  parts.push_back({"},\n  \"actors\": " + document::laid_out(Json::array({film.actor})) + "}\n"});
  return parts;
}

}  // namespace mars::importer
