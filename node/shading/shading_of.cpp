#include "node/shading/shading_of.h"

#include <algorithm>

namespace mars::shading {

Shading shading_of(const geometry::Scene& scene, wire::PixelFormat format) {
  const wire::FilmSettings& settings = scene.film().settings();
  Shading shading{};
  shading.materials = scene.film().materials().data();
  shading.lights = scene.lights().data();
  shading.light_count = static_cast<std::uint32_t>(scene.lights().size());
  shading.casting_count = scene.casting_count();
  shading.projection = scene.projection();
  shading.pattern = shape::sample_pattern(settings.samples);
  shading.encoding = color::encoding_of(settings, scene.camera(), format);
  std::ranges::copy(settings.background, shading.background);
  shading.ambient = settings.ambient;
  std::ranges::copy(scene.up(), shading.up);
  shading.fog = settings.fog;
  shading.pixels = format;
  return shading;
}

}  // namespace mars::shading
