#include "host/content/animator/reading/read_lights.h"

#include <glm/geometric.hpp>

#include "host/content/animator/reading/read_keys.h"

namespace mars::animator {
namespace {

constexpr double kFullyLit = 0.8;  // of a cone of which one number is given

glm::dvec3 direction_of(const document::Element& element) {
  const glm::dvec3 direction = document::read_vector(element);
  const double length = glm::length(direction);
  if (length < 1e-9) element.refuse("has no length", "write a vector to the light");
  return direction / length;
}

glm::dvec2 cone_of(const document::Element& element) {
  if (element.kind() != document::Kind::list) {
    const double outer = document::read_number(element, keys::range_of("light", "cone"));
    return {kFullyLit * outer, outer};
  }
  document::require_size(element, 2);
  auto angle = element.begin();
  const double inner = document::read_number(*angle, keys::range_of("light", "cone")),
               outer = document::read_number(*++angle, keys::range_of("light", "cone"));
  if (inner > outer)
    element.refuse("is " + document::shown(inner) + " degrees wide inside and " + document::shown(outer) + " outside",
                   "write the inner angle first");
  return {inner, outer};
}

void read_light_keys(const document::Element& list, LightMotion& light, Channel<glm::dvec3>& direction,
                     Channel<glm::dvec3>& place) {
  read_keys(list, keys::object("light_key"), [&](const document::Fields& key, std::uint32_t frame, const Ease& ease) {
    add_key(direction, key, "direction", frame, ease, direction_of);
    add_key(place, key, "place", frame, ease, place_of);
    add_key(light.at, key, "at", frame, ease, place_of);
    add_key(light.cone, key, "cone", frame, ease, cone_of);
    add_key(light.reach, key, "reach", frame, ease, number_of(key, "reach"));
    add_key(light.color, key, "color", frame, ease, document::read_color);
    add_key(light.intensity, key, "intensity", frame, ease, number_of(key, "intensity"));
  });
}

wire::LightKind kind_of(const document::Element& element, bool direction, bool place, bool at) {
  if (direction == place)
    element.refuse(place ? "has both a direction and a place" : "has neither a direction nor a place",
                   "give direction to the light if it is far away, or its place if it is near");
  if (direction && at)
    element.refuse("has both a direction, which is to a far light, and a point at which it shines",
                   "for a spot give place and at; for a far light direction alone");
  return direction ? wire::LightKind::directional : at ? wire::LightKind::spot : wire::LightKind::point;
}

LightMotion read_light(const document::Element& element) {
  const document::Fields fields(element, keys::object("light"));
  LightMotion light;
  Channel<glm::dvec3> direction, place;
  if (const auto keys = fields.find("keys")) read_light_keys(*keys, light, direction, place);
  const auto has = [&](const auto& channel, std::string_view key) { return !channel.empty() || fields.find(key); };
  light.kind = kind_of(element, has(direction, "direction"), has(place, "place"), has(light.at, "at"));
  if (light.kind != wire::LightKind::spot && has(light.cone, "cone"))
    element.refuse("has a cone, but no point at which it shines", "make a spot of it: give place and at");
  if (light.kind == wire::LightKind::directional && has(light.reach, "reach"))
    element.refuse("has a direction, so it is far away, and a reach", "leave reach out, or give its place instead");
  if (light.kind == wire::LightKind::directional)
    settle(direction, fields, "direction", direction_of);
  else
    settle(place, fields, "place", place_of);
  light.vector = light.kind == wire::LightKind::directional ? direction : place;
  if (light.kind == wire::LightKind::spot) {
    settle(light.at, fields, "at", place_of);
    settle(light.cone, fields, "cone", cone_of);
  }
  if (has(light.reach, "reach")) settle(light.reach, fields, "reach", number_of(fields, "reach"));
  settle(light.color, fields, "color", document::read_color);
  settle(light.intensity, fields, "intensity", number_of(fields, "intensity"));
  return light;
}

}  // namespace

std::vector<LightMotion> read_lights(const document::Element& list) {
  document::require_kind(list, document::Kind::list);
  const double most = keys::range_of("film", "lights").highest;
  if (static_cast<double>(list.size()) > most)
    list.refuse("has " + std::to_string(list.size()) + " lights", "at most " + document::shown(most));
  std::vector<LightMotion> lights;
  for (const document::Element element : list) lights.push_back(read_light(element));
  return lights;
}

Ambient read_ambient(const document::Element& element) {
  if (element.kind() != document::Kind::object) {
    const glm::dvec3 color = document::read_color(element);
    return {color, color};
  }
  const document::Fields fields(element, keys::object("ambient"));
  return {document::read_color(fields.required("sky")), document::read_color(fields.required("ground"))};
}

Fog read_fog(const document::Element& element, const glm::dvec3& background) {
  const document::Fields fields(element, keys::object("fog"));
  const auto color = fields.find("color");
  const Fog fog{color ? document::read_color(*color) : background, fields.number("start"),
                document::read_number(fields.required("end"), fields.key("end"))};
  if (fog.end <= fog.start)
    element.refuse("ends at " + document::shown(fog.end) + ", not beyond its start " + document::shown(fog.start),
                   "make end larger");
  return fog;
}

}  // namespace mars::animator
