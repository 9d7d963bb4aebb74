#include "tests/render/looks.h"

#include <algorithm>
#include <utility>

namespace mars::test {
namespace {

wire::Track still_track(wire::FilmData& film, std::size_t value) {
  film.changes.push_back({0, static_cast<std::uint32_t>(value)});
  return {static_cast<std::uint32_t>(film.changes.size() - 1), 1};
}

// Gives each segment a material of its own: change(number of the segment, its material).
template <typename Change>
void change_materials(wire::FilmData& film, const Change& change) {
  const std::vector<wire::Material> before = std::exchange(film.materials, {});
  for (wire::Segment& segment : film.segments) {
    wire::Material material = before[film.changes[segment.material.first].value];
    change(static_cast<std::uint32_t>(film.materials.size()), material);
    segment.material = still_track(film, film.materials.size());
    film.materials.push_back(material);
  }
}

void add_spot(wire::FilmData& film) {
  wire::Light spot{wire::LightKind::spot, {-2, -6, 6}, {2, 1.8f, 1.2f}, {0.25f, 0.6f, -0.76f}, 0.96f, 0.85f, 9};
  film.light_tracks.push_back(still_track(film, film.lights.size()));
  film.lights.push_back(spot);
}

}  // namespace

wire::FilmData with_samples(wire::FilmData film, std::uint32_t samples) {
  film.settings.samples = samples;
  return film;
}

wire::FilmData in_pure_colors(wire::FilmData film) {
  constexpr std::array<float, 3> kColors[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                              {1, 1, 0}, {0, 1, 1}, {1, 1, 1}};
  change_materials(film, [&](std::uint32_t number, wire::Material& material) {
    material = {kColors[number % std::size(kColors)], 1, 0, 0, 1, material.sides};
  });
  film.lights.clear();
  film.light_tracks.clear();
  return film;
}

wire::FilmData richly_lit(wire::FilmData film) {
  change_materials(film, [](std::uint32_t number, wire::Material& material) {
    material.reflection = static_cast<wire::Reflection>(number % 4);
    material.interpolation = static_cast<wire::Interpolation>(number % 3);
    material.roughness = 0.2f + 0.1f * static_cast<float>(number % 7);
    material.metallic = 0.5f * static_cast<float>(number % 3);
    material.refraction = number % 2 == 0 ? 1.5f : 8.0f;
  });
  add_spot(film);
  film.settings.color_space = wire::ColorSpace::linear;
  film.settings.curve = wire::Curve::filmic;
  film.settings.background = {0.3f, 0.35f, 0.5f};
  film.settings.ambient = {{0.8f, 0.9f, 1.2f}, {0.4f, 0.3f, 0.2f}};
  film.settings.fog = {{0.5f, 0.55f, 0.6f}, 9, 22};
  for (wire::Camera& camera : film.cameras) camera.exposure = 1.3;
  return film;
}

wire::FilmData casting(wire::FilmData film, std::initializer_list<float> sizes) {
  for (std::size_t k = 0; const float size : sizes) {
    wire::Light& light = film.lights.at(k++);
    light.casts = size >= 0 ? 1 : 0;
    light.size = size >= 0 ? size : 0;
  }
  return film;
}

wire::FilmData orthographic(wire::FilmData film) {
  for (wire::Camera& camera : film.cameras) {
    camera.projection = wire::Projection::orthographic;
    camera.focal /= std::max(-camera.world_to_eye.m[2][3], 3.0);
  }
  return film;
}

wire::FilmData shifted(wire::FilmData film, double right, double up) {
  for (wire::Camera& camera : film.cameras) {
    camera.shift_x = right;
    camera.shift_y = up;
  }
  return film;
}

}  // namespace mars::test
