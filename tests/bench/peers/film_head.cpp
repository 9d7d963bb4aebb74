#include "tests/bench/peers/film_head.h"

#include <bit>

#include "hal/failure/failure.h"

namespace mars::bench {

void refuse(const std::string& what, const std::string& where) {
  throw Failure("a mesh cannot hold " + what, where, "use a scene like those in examples/make_scenes.py");
}

namespace {

void check_light(const wire::PackedFilm& film, const std::string& where) {
  const wire::FilmSettings& settings = film.settings();
  if (settings.color_space != wire::ColorSpace::coded) refuse("linear colours", where);
  if (settings.fog.end > settings.fog.start) refuse("fog", where);
  if (settings.ambient != wire::AmbientLight{}) refuse("coloured ambient light", where);
  const auto& lights = film.light_tracks();
  if (lights.size() != 1 || lights[0].count != 1 ||
      film.lights()[film.value_at(lights[0], 0)].kind != wire::LightKind::directional)
    refuse("other light than one direction", where);
}

void check_materials(const wire::PackedFilm& film, const std::string& where) {
  const wire::Material& all = film.materials()[0];
  for (const wire::Material& m : film.materials()) {
    if (m.ambient != all.ambient || m.diffuse != all.diffuse || m.specular != all.specular ||
        m.exponent != all.exponent)
      refuse("materials that differ in more than colour", where);
    if (m.interpolation != wire::Interpolation::phong || m.reflection != wire::Reflection::phong)
      refuse("other surfaces than Phong's", where);
  }
  if (!(all.exponent >= 1) || !std::has_single_bit(static_cast<unsigned>(all.exponent)))
    refuse("an exponent that is no power of two", where);
}

}  // namespace

void check_look(const wire::PackedFilm& film, const std::string& where) {
  check_light(film, where);
  check_materials(film, where);
}

MeshHead head_of(const geometry::Scene& scene) {
  const wire::FilmSettings& settings = scene.film().settings();
  const shape::Projection& p = scene.projection();
  const geometry::EyeLight& light = scene.lights()[0];
  MeshHead head{};
  head.magic = kMeshMagic;
  head.width = settings.width;
  head.height = settings.height;
  head.scale = p.scale;
  head.center = {p.center[0], p.center[1]};
  head.near = p.near;
  head.background = settings.background;
  head.to_light = {light.vector[0], light.vector[1], light.vector[2]};
  head.light = {light.color[0], light.color[1], light.color[2]};
  const wire::Material& material = scene.film().materials()[0];
  head.ambient = material.ambient;
  head.diffuse = material.diffuse;
  head.specular = material.specular;
  head.squarings = static_cast<std::uint32_t>(std::countr_zero(static_cast<unsigned>(material.exponent)));
  head.frames = settings.frames;
  return head;
}

}  // namespace mars::bench
