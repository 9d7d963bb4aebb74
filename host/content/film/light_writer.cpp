#include "host/content/film/light_writer.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/direction.h"
#include "host/content/animator/reading/read_lights.h"
#include "host/content/document/shown_color.h"
#include "host/content/elementary/elementary.h"

namespace mars::film {
namespace {

std::array<float, 3> floats(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

glm::dvec3 light_from(const glm::dvec3& color, wire::ColorSpace space) {
  const glm::dvec3 shown = glm::clamp(color, 0.0, 1.0);
  if (space == wire::ColorSpace::coded) return shown;
  return {document::light_of_shown(shown.x), document::light_of_shown(shown.y), document::light_of_shown(shown.z)};
}

double half_in_radians(double degrees) { return degrees * (std::numbers::pi / 360); }

// Of half the angle that a cone opens.
float cosine_of(double angle) {
  const keys::Range& range = keys::range_of("light", "cone");
  return static_cast<float>(elementary::cos(half_in_radians(std::clamp(angle, range.lowest, range.highest))));
}

class LightWriter {
 public:
  LightWriter(const animator::Film& film, WrittenFrames frames, wire::FilmData& data)
      : film_(film), frames_(frames), data_(data) {}

  void write(const animator::LightMotion& light) {
    TrackWriter<wire::Light> track(data_.lights);
    const std::uint32_t frames = frames_to_see(frames_.count, light.vector, light.color, light.intensity, light.reach,
                                               light.at, light.cone, light.size);
    for (std::uint32_t frame = 0; frame < frames; ++frame) track.add(frame, light_at(light, frames_.first + frame));
    data_.light_tracks.push_back(track.write(data_.changes));
  }

 private:
  wire::Light light_at(const animator::LightMotion& motion, std::uint32_t frame) const {
    wire::Light light{motion.kind, {}, color_at(motion, frame)};
    const bool far = motion.kind == wire::LightKind::directional;
    const glm::dvec3 vector =
        far ? animator::direction_at(motion.vector, frame) : animator::value_at(motion.vector, frame);
    light.vector = floats(vector);
    if (motion.kind == wire::LightKind::spot) aim(motion, vector, frame, light);
    if (!motion.reach.empty()) light.reach = static_cast<float>(within("reach", motion, motion.reach, frame));
    if (motion.casts) cast(motion, frame, light);
    return light;
  }

  std::array<float, 3> color_at(const animator::LightMotion& motion, std::uint32_t frame) const {
    const double intensity = std::max(0.0, animator::value_at(motion.intensity, frame));
    const glm::dvec3 light = intensity * light_from(animator::value_at(motion.color, frame), film_.color);
    return floats(glm::min(light, double{wire::kMostLight}));
  }

  // Splines go beyond a key's range.
  static double within(std::string_view key, const animator::LightMotion& motion,
                       const animator::Channel<double>& channel, std::uint32_t frame) {
    const keys::Range& range = keys::object("light").key(key).range_of(static_cast<unsigned>(motion.kind));
    return std::clamp(animator::value_at(channel, frame), range.lowest, range.highest);
  }

  static void cast(const animator::LightMotion& motion, std::uint32_t frame, wire::Light& light) {
    const double size = within("size", motion, motion.size, frame);
    const bool far = motion.kind == wire::LightKind::directional;
    light.casts = 1;
    light.size = static_cast<float>(far ? elementary::tan(half_in_radians(size)) : size / 2);
  }

  void aim(const animator::LightMotion& motion, const glm::dvec3& place, std::uint32_t frame,
           wire::Light& light) const {
    const glm::dvec3 way = animator::value_at(motion.at, frame) - place;
    const double length = glm::length(way);
    if (length < 1e-9) refuse_aim(frame);
    light.axis = floats(way / length);
    const glm::dvec2 cone = animator::value_at(motion.cone, frame);
    light.cos_outer = cosine_of(cone.y);
    light.cos_inner = std::max(cosine_of(cone.x), light.cos_outer);
  }

  [[noreturn]] void refuse_aim(std::uint32_t frame) const {
    const std::string light = "lights[" + std::to_string(data_.light_tracks.size()) + "], frame ";
    throw Failure("has its place where it shines at",
                  (film_.source.empty() ? "" : film_.source + ": ") + light + std::to_string(frame),
                  "move place or at");
  }

  const animator::Film& film_;
  const WrittenFrames frames_;
  wire::FilmData& data_;
};

}  // namespace

std::array<float, 3> light_of(const glm::dvec3& color, wire::ColorSpace space) {
  return floats(light_from(color, space));
}

std::array<float, 3> shown_of(const std::array<float, 3>& light, wire::ColorSpace space) {
  std::array<float, 3> shown = light;
  if (space == wire::ColorSpace::linear)
    for (float& channel : shown) channel = static_cast<float>(document::shown_of_light(channel));
  return shown;
}

void write_light_settings(const animator::Film& film, wire::FilmSettings& settings) {
  settings.samples = film.samples;
  settings.color_space = film.color;
  settings.curve = film.color == wire::ColorSpace::linear ? film.curve : wire::Curve::none;
  settings.background = light_of(film.background, film.color);
  settings.ambient = {light_of(film.ambient.sky, film.color), light_of(film.ambient.ground, film.color)};
  if (film.fog)
    settings.fog = {light_of(film.fog->color, film.color), static_cast<float>(film.fog->start),
                    static_cast<float>(film.fog->end)};
}

void write_lights(const animator::Film& film, WrittenFrames frames, wire::FilmData& data) {
  LightWriter writer(film, frames, data);
  for (const animator::LightMotion& light : film.lights) writer.write(light);
}

}  // namespace mars::film
