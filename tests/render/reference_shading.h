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
  ReferenceShading(const wire::PackedFilm& film, std::uint32_t frame);

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
  std::array<double, 3> toward_eye(const std::array<double, 3>& place) const;
  Point point_at(const geometry::Triangle& t, std::int32_t x, std::int32_t y) const;
  // Light that the point sends to the eye, without fog.
  Color light_of(const wire::Material& material, const Point& point) const;
  Color ambient_of(const wire::Material& material, const Point& point) const;
  // Light of one of the corners that the triangle had before it was clipped.
  Color light_of_corner(const raster::PlainTriangle& triangle, std::size_t corner) const;
  // The light of its corners, interpolated in perspective.
  Color gouraud_light(const raster::PlainTriangle& triangle, std::int32_t x, std::int32_t y) const;
  // The light of its middle, with the normal of its plane.
  Color flat_light(const raster::PlainTriangle& triangle) const;
  Color in_fog(const Color& light, double w) const;

  geometry::Scene scene_;
};

}  // namespace mars::test
