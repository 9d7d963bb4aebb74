// The plain twin of shading (docs/shading.md): one place of one triangle at a time, the formulas as books have them, in
// double precision, with the C library's functions.
#pragma once

#include <array>
#include <cstdint>

#include "node/geometry/scene.h"
#include "node/wire/film.h"
#include "tests/node/raster/plain_set_up.h"

namespace mars::test {

using Color = std::array<double, 3>;  // red, green, blue

class ReferenceShading {
 public:
  ReferenceShading(const wire::FilmView& film, std::uint32_t frame);

  // The light from `triangle` at (x, y) in 1/256 pixel, fog and all; in coded films 0..1.
  Color shade(const raster::PlainTriangle& triangle, std::int32_t x, std::int32_t y) const;

  const wire::FilmSettings& settings() const { return scene_.film().settings(); }
  const wire::Camera& camera() const { return scene_.camera(); }

 private:
  // A place of a surface in eye space; all three directions are units.
  struct Point {
    std::array<double, 3> place;
    std::array<double, 3> normal;
    std::array<double, 3> eye;  // to it
  };
  Point point_at(const geometry::Triangle& t, std::int32_t x, std::int32_t y) const;
  // Light that the point sends to the eye, without fog.
  Color light_of(const wire::Material& material, const Point& point) const;
  Color ambient_of(const wire::Material& material, const Point& point) const;
  // The mean of its corners' light, weighted by `weight` / w.
  Color light_of_corners(const raster::PlainTriangle& triangle, const std::array<double, 3>& weight) const;
  Color in_fog(const Color& light, double w) const;

  geometry::Scene scene_;
};

}  // namespace mars::test
