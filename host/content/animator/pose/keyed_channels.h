// Which channel of the camera or of a light has the values of a key of the table (host/content/keys): the one place
// that joins the names to the members.
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <iterator>
#include <string_view>
#include <variant>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/film.h"
#include "host/content/keys/key.h"

namespace mars::animator {

template <typename Motion, typename... Values>
struct KeyedChannel {
  std::string_view key;
  std::variant<Channel<Values> Motion::*...> channel;
};

using CameraChannel = KeyedChannel<CameraMotion, double, glm::dvec2, glm::dvec3, Point>;
inline constexpr CameraChannel kCameraChannels[] = {
    {"eye", &CameraMotion::eye},          {"at", &CameraMotion::at},         {"up", &CameraMotion::up},
    {"fov", &CameraMotion::fov},          {"height", &CameraMotion::height}, {"shift", &CameraMotion::shift},
    {"exposure", &CameraMotion::exposure}};

using LightChannel = KeyedChannel<LightMotion, double, glm::dvec2, glm::dvec3>;
inline constexpr LightChannel kLightChannels[] = {
    {"direction", &LightMotion::vector},    {"place", &LightMotion::vector}, {"at", &LightMotion::at},
    {"cone", &LightMotion::cone},           {"reach", &LightMotion::reach},  {"color", &LightMotion::color},
    {"intensity", &LightMotion::intensity}, {"size", &LightMotion::size}};

// Calls act(key, channel) for each key that may be keyed and that things of this kind have, in the table's order.
template <typename Motion, typename Channels, typename Act>
void for_each_channel(Motion& motion, const keys::Object& object, unsigned kind, const Channels& channels, Act act) {
  for (const keys::Key& key : object.keys) {
    if (!key.keyed || !key.is_of(kind)) continue;
    const auto found = std::ranges::find_if(channels, [&](const auto& each) { return each.key == key.name; });
    check(found != std::end(channels), "a key that may be keyed has a channel");
    std::visit([&](auto member) { act(key, motion.*member); }, found->channel);
  }
}

template <typename Act>
void for_each_channel(const CameraMotion& camera, wire::ColorSpace color, Act act) {
  for_each_channel(camera, keys::object("camera"), static_cast<unsigned>(color), kCameraChannels, act);
}

// `Light` is LightMotion, const or not.
template <typename Light, typename Act>
void for_each_channel(Light& light, Act act) {
  for_each_channel(light, keys::object("light"), static_cast<unsigned>(light.kind), kLightChannels, act);
}

}  // namespace mars::animator
