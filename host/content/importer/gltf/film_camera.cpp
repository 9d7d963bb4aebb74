#include "host/content/importer/gltf/film_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "host/content/importer/motions/film_text.h"

namespace mars::importer {
namespace {

using document::Json;

constexpr double kViewTrue = 1e-6;  // of the size of what is seen
constexpr double kUsualAspect = 16.0 / 9, kSameAspect = 2e-3;
constexpr double kPictureHeight = 540, kGreatestSide = 16384;  // pixels
constexpr double kNearestPlane = 1e-6, kFarthestPlane = 1e9;
constexpr double kNarrowestView = 0.01, kWidestView = 179;  // degrees, that a film's camera may see
constexpr double kLowestView = 1e-5, kHighestView = 1e9;    // units, of an orthographic one

// Of a camera, by frame.
struct View {
  std::vector<glm::dvec3> eye, ahead, up;
};

glm::dvec3 unit(const glm::dvec4& axis, const glm::dvec3& otherwise) {
  const glm::dvec3 vector(axis);
  return glm::length(vector) > 0 ? glm::normalize(vector) : otherwise;
}

std::vector<View> views_of(const std::vector<GltfCamera>& cameras, const NodesInFilm& nodes) {
  std::vector<View> views(cameras.size());
  for (std::size_t frame = 0; frame < nodes.frames(); ++frame) {
    const std::vector<glm::dmat4> now = nodes.at(frame);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      const glm::dmat4& node = now[cameras[i].node];
      views[i].eye.emplace_back(node[3]);
      views[i].ahead.push_back(-unit(node[2], {0, 1, 0}));
      views[i].up.push_back(unit(node[1], {0, 0, 1}));
    }
  }
  return views;
}

bool moves(const View& view) {
  const auto changes = [](const std::vector<glm::dvec3>& values) {
    return std::ranges::any_of(values, [&](const glm::dvec3& value) { return value != values[0]; });
  };
  return changes(view.eye) || changes(view.ahead) || changes(view.up);
}

std::optional<std::array<std::uint32_t, 2>> size_of(const GltfCamera& camera) {
  if (!camera.aspect || std::abs(*camera.aspect / kUsualAspect - 1) < kSameAspect) return std::nullopt;
  const double width = std::clamp(2 * std::round(kPictureHeight / 2 * *camera.aspect), 2.0, kGreatestSide);
  return std::array{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(kPictureHeight)};
}

// What the file does not say is as is usual; what a film cannot have is the nearest that it can.
Json lens_of(const GltfCamera& camera, double factor) {
  Json json = Json::object();
  if (camera.yfov) {
    json["fov"] =
        document::plain_number(std::clamp(*camera.yfov * 180 / std::numbers::pi, kNarrowestView, kWidestView));
  } else {
    json["projection"] = "orthographic";
    json["height"] = document::plain_number(std::clamp(2 * camera.ymag * factor, kLowestView, kHighestView));
  }
  const double near = camera.znear ? std::clamp(*camera.znear * factor, kNearestPlane, kFarthestPlane) : kNearestPlane;
  const double far = camera.zfar ? std::clamp(*camera.zfar * factor, kNearestPlane, kFarthestPlane) : kFarthestPlane;
  if (camera.znear && near < far) json["near"] = document::plain_number(near);
  if (camera.zfar && near < far) json["far"] = document::plain_number(far);
  return json;
}

}  // namespace

FilmCamera film_camera(const std::vector<GltfCamera>& cameras, const NodesInFilm& nodes, const modeler::Box& seen,
                       double factor) {
  const std::vector<View> views = views_of(cameras, nodes);
  const auto moving = std::ranges::find_if(views, moves);
  const std::size_t chosen = moving == views.end() ? 0 : static_cast<std::size_t>(moving - views.begin());
  const View& view = views[chosen];
  const glm::dvec3 middle = (seen.min + seen.max) / 2.0;
  const double size = std::max(glm::length(seen.max - seen.min), kNearestPlane);
  const double ahead = std::max(glm::dot(middle - view.eye[0], view.ahead[0]), size / 10);
  std::vector<glm::dvec3> at;
  for (std::size_t frame = 0; frame < view.eye.size(); ++frame)
    at.push_back(view.eye[frame] + ahead * view.ahead[frame]);
  KeyedText text(lens_of(cameras[chosen], factor));
  text.add("eye", view.eye, kViewTrue * size);
  text.add("at", at, kViewTrue * size);
  text.add("up", view.up, kViewTrue);
  return {text.finished(), size_of(cameras[chosen])};
}

}  // namespace mars::importer
