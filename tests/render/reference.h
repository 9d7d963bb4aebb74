// The plain twin of the renderer: every triangle against every sample of its box, exact integers for coverage,
// the rule of ties written out, Phong's formula in double precision. It shares with the nodes what defines the
// polygons (dicing, placing of meshlets, clipping) and nothing of how they are set up, drawn, divided or sent.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "node/wire/film.h"
#include "tests/node/raster/plain_set_up.h"

namespace mars::test {

struct ReferenceSample {
  std::optional<std::size_t> triangle;  // index into triangles; none: background
  float depth = 0;
};

struct Reference {
  std::vector<raster::PlainTriangle> triangles;
  std::vector<bool> moving;              // of each triangle
  std::vector<ReferenceSample> samples;  // rows from the top
  std::uint32_t width = 0;

  const ReferenceSample& at(std::uint32_t column, std::uint32_t row) const { return samples[row * width + column]; }
};

// Draws `frame`; the film's intervals say which segments move.
Reference draw_reference(const wire::FilmView& film, std::uint32_t frame);

// The colour (red, green, blue, 0..255, not rounded) of a sample that shows a triangle.
struct Color {
  double channel[3];
};
Color shade_reference(const wire::FilmView& film, std::uint32_t frame, const Reference& reference, std::uint32_t column,
                      std::uint32_t row);

}  // namespace mars::test
