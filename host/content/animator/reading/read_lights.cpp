#include "host/content/animator/reading/read_lights.h"

#include <glm/geometric.hpp>
#include <set>

#include "host/content/animator/pose/keyed_channels.h"
#include "host/content/animator/reading/read_keys.h"
#include "host/content/keys/text.h"

namespace mars::animator {
namespace {

constexpr double kFullyLit = 0.8;  // of a cone of which one number is given

glm::dvec3 direction_of(const document::Element& element) {
  const glm::dvec3 direction = document::read_vector(element);
  const double length = glm::length(direction);
  if (length < 1e-9) element.refuse("has no length", "write a vector to the light");
  return direction / length;
}

glm::dvec2 cone_of(const document::Element& element, const keys::Key& key) {
  if (element.kind() != document::Kind::list) {
    const double outer = document::read_number(element, key.range);
    return {kFullyLit * outer, outer};
  }
  document::require_size(element, 2);
  auto angle = element.begin();
  const double inner = document::read_number(*angle, key.range), outer = document::read_number(*++angle, key.range);
  if (inner > outer)
    element.refuse("is " + document::shown(inner) + " degrees wide inside and " + document::shown(outer) + " outside",
                   "write the inner angle first");
  return {inner, outer};
}

// Readers of a key's value for its channel, of a light of that kind.
void read_value(const document::Element& element, const keys::Key& key, wire::LightKind kind, double& value) {
  value = document::read_number(element, key.range_of(static_cast<unsigned>(kind)));
}
void read_value(const document::Element& element, const keys::Key& key, wire::LightKind, glm::dvec2& value) {
  value = cone_of(element, key);
}
void read_value(const document::Element& element, const keys::Key& key, wire::LightKind, glm::dvec3& value) {
  value = key.type == "color"       ? document::read_color(element)
          : key.name == "direction" ? direction_of(element)
                                    : place_of(element);
}

// As settle() and add_key() want it.
template <typename Value>
auto reader_of(const keys::Key& key, wire::LightKind kind, const Channel<Value>&) {
  return [&key, kind](const document::Element& element) {
    Value value{};
    read_value(element, key, kind, value);
    return value;
  };
}

// Names of what the light has, in itself or in its keys.
std::set<std::string_view> given_keys(const document::Fields& fields) {
  std::set<std::string_view> given;
  const auto add = [&](const document::Fields& object) {
    for (const keys::Key& key : keys::object("light").keys)
      if (key.keyed && object.find(key.name)) given.insert(key.name);
  };
  add(fields);
  if (const auto keys = fields.find("keys"))
    read_keys(*keys, keys::object("light_key"),
              [&](const document::Fields& key, std::uint32_t, const Ease&) { add(key); });
  return given;
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

// "point and spot lights have it".
std::string owners_of(const keys::Object& light, const keys::Key& key) {
  std::string owners;
  for (unsigned kind = 0; kind < light.kinds.size(); ++kind)
    if (key.is_of(kind)) owners += (owners.empty() ? "" : " and ") + std::string(light.kinds[kind].name);
  return owners + " lights have it";
}

void refuse_keys_of_others(const document::Element& element, wire::LightKind kind,
                           const std::set<std::string_view>& given) {
  const keys::Object& light = keys::object("light");
  const auto number = static_cast<unsigned>(kind);
  for (const std::string_view name : given)
    if (const keys::Key& key = light.key(name); !key.is_of(number))
      element.refuse("is a " + std::string(light.kinds[number].name) + " light and has a " + std::string(name),
                     "leave " + std::string(name) + " out: " + owners_of(light, key));
}

// A channel of a key with neither a value nor a default stays empty.
template <typename Value>
void settle_by_table(Channel<Value>& channel, const document::Fields& fields, const keys::Key& key,
                     wire::LightKind kind) {
  const bool has_default = key.number || !key.json.empty();
  if (has_default || fields.find(key.name)) settle(channel, fields, key.name, reader_of(key, kind, channel));
}

LightMotion read_light(const document::Element& element) {
  const document::Fields fields(element, keys::object("light"));
  const std::set<std::string_view> given = given_keys(fields);
  LightMotion light;
  light.kind = kind_of(element, given.contains("direction"), given.contains("place"), given.contains("at"));
  refuse_keys_of_others(element, light.kind, given);
  light.casts = fields.flag("shadow");
  if (const auto keys = fields.find("keys"))
    read_keys(*keys, keys::object("light_key"),
              [&](const document::Fields& at_frame, std::uint32_t frame, const Ease& ease) {
                for_each_channel(light, [&](const keys::Key& key, auto& channel) {
                  add_key(channel, at_frame, key.name, frame, ease, reader_of(key, light.kind, channel));
                });
              });
  for_each_channel(light,
                   [&](const keys::Key& key, auto& channel) { settle_by_table(channel, fields, key, light.kind); });
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
