#include "host/content/importer/gltf/film_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "host/content/document/shown_color.h"
#include "host/content/importer/motions/film_text.h"

namespace mars::importer {
namespace {

using document::Json;

constexpr std::size_t kMostLights = 64;
constexpr double kGreatestIntensity = 1000;
constexpr double kDarkest = 0.1, kBrightest = 4;  // that lights of a film are together, without being dimmed
constexpr double kNearLight = 0.01;               // of what is seen: nearer to a light it gets hardly brighter
constexpr double kLightTrue = 1e-6;               // of the size of what is seen
constexpr double kNarrowestCone = 0.01, kWidestCone = 180;  // degrees that a cone opens

glm::dvec3 axis_of(const glm::dmat4& node) {
  const glm::dvec3 z(node[2]);
  return glm::length(z) > 0 ? glm::normalize(z) : glm::dvec3(0, 0, 1);
}

// Of a white surface in the middle that faces it, as a share of what light of 1 makes it.
double brightness_in_the_middle(const GltfLight& light, const glm::dmat4& node, const glm::dvec3& middle, double size,
                                double factor) {
  const double color = std::max({light.color.x, light.color.y, light.color.z});
  if (light.in_the_middle) return color * light.intensity;
  if (light.kind == GltfLightKind::directional) return color * light.intensity / std::numbers::pi;
  const double metres = std::max(glm::length(glm::dvec3(node[3]) - middle), kNearLight * size) / factor;
  return color * light.intensity / (metres * metres * std::numbers::pi);
}

// In lux and candela.
GltfLight in_units(GltfLight light, const glm::dmat4& node, const glm::dvec3& middle, double size, double factor) {
  if (!light.in_the_middle) return light;
  const double intensity = light.intensity;
  light.in_the_middle = false;
  light.intensity =
      intensity / brightness_in_the_middle({.node = light.node, .kind = light.kind}, node, middle, size, factor);
  return light;
}

double dimmed(double brightness) {
  if (!(brightness > 0) || (brightness >= kDarkest && brightness <= kBrightest)) return 1;
  return 1 / brightness;
}

Json shown(const glm::dvec3& color) {
  Json json = Json::array();
  for (int i = 0; i < 3; ++i)
    json.push_back(
        document::plain_number(std::round(document::shown_of_light(std::clamp(color[i], 0.0, 1.0)) * 1000) / 1000));
  return json;
}

// MARS's falls off as 1 / (1 + (d / reach)^2): far from the light that is (reach / d)^2, the square that glTF has.
void add_reach(const GltfLight& light, double size, double factor, double dimmed, Json& json) {
  const double squared = light.intensity * dimmed * factor * factor / std::numbers::pi;  // brightness times distance^2
  const double reach =
      std::max({kNearLight * size, std::sqrt(std::max(squared, 0.0) / kGreatestIntensity) * 1.001, 1e-6});
  json["reach"] = document::plain_number(reach);
  json["intensity"] = document::plain_number(std::max(squared, 0.0) / (reach * reach));
}

Json cone_of(const GltfLight& light) {
  const auto opens = [](double half) {
    return std::clamp(2 * half * 180 / std::numbers::pi, kNarrowestCone, kWidestCone);
  };
  const double outer = opens(light.outer);
  return Json::array({document::plain_number(std::min(opens(light.inner), outer)), document::plain_number(outer)});
}

class LightText {
 public:
  LightText(const GltfLight& light, const NodesInFilm& nodes) : light_(light) {
    for (std::size_t frame = 0; frame < nodes.frames(); ++frame) places_.push_back(nodes.at(frame)[light.node]);
  }

  Json json(double size, double factor, double dimmed) const {
    Json beside = Json::object();
    if (light_.color != glm::dvec3(1)) beside["color"] = shown(light_.color);
    if (light_.kind == GltfLightKind::directional)
      beside["intensity"] =
          document::plain_number(std::clamp(light_.intensity * dimmed / std::numbers::pi, 0.0, kGreatestIntensity));
    else
      add_reach(light_, size, factor, dimmed, beside);
    if (light_.kind == GltfLightKind::spot) beside["cone"] = cone_of(light_);
    KeyedText text(std::move(beside));
    add_places(text, size);
    return text.finished();
  }

 private:
  void add_places(KeyedText& text, double size) const {
    std::vector<glm::dvec3> places, toward, at;
    for (const glm::dmat4& node : places_) {
      places.emplace_back(node[3]);
      toward.push_back(axis_of(node));
      at.push_back(places.back() - size * toward.back());
    }
    if (light_.kind == GltfLightKind::directional) return text.add("direction", toward, kLightTrue);
    text.add("place", places, kLightTrue * size);
    if (light_.kind == GltfLightKind::spot) text.add("at", at, kLightTrue * size);
  }

  GltfLight light_;
  std::vector<glm::dmat4> places_;  // of its node, by frame
};

}  // namespace

FilmLights film_lights(const std::vector<GltfLight>& lights, const NodesInFilm& nodes, const glm::dvec3& middle,
                       double size, double factor) {
  FilmLights film;
  if (lights.empty()) return film;
  film.lights = std::min(lights.size(), kMostLights);
  film.too_many = lights.size() - film.lights;
  const std::vector<glm::dmat4> first = nodes.at(0);
  double brightness = 0;
  for (const GltfLight& light : lights)
    brightness += brightness_in_the_middle(light, first[light.node], middle, size, factor);
  film.dimmed = dimmed(brightness);
  film.json = Json::array();
  for (std::size_t i = 0; i < film.lights; ++i)
    film.json.push_back(LightText(in_units(lights[i], first[lights[i].node], middle, size, factor), nodes)
                            .json(size, factor, film.dimmed));
  return film;
}

}  // namespace mars::importer
