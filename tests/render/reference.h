// The plain twin of the renderer: every triangle against every sample of its box, exact integers for coverage, the
// rule of ties and the two layers written out, light in double precision (reference_shading.h). It shares with the
// nodes what defines the polygons (dicing, placing of meshlets, clipping), where samples lie and how light is encoded,
// and nothing of how triangles are set up, drawn, grouped, divided or sent.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "node/shape/sample_pattern.h"
#include "node/wire/film.h"
#include "tests/node/raster/plain_set_up.h"
#include "tests/render/reference_shading.h"

namespace mars::test {

struct ReferenceSample {
  std::optional<std::size_t> triangle;  // index into triangles
  float depth = 0;                      // Projection::nothing where there is none
};

// The samples of a pixel that show the same triangle, which is shaded once, at the one nearest to its centre.
struct ReferenceGroup {
  std::size_t triangle;
  std::uint32_t sample;  // the nearest
  std::uint32_t seen;    // samples, without those that a mover covers
};

struct Reference {
  std::vector<raster::PlainTriangle> triangles;
  std::vector<bool> moving;             // of each triangle
  std::vector<ReferenceSample> still;   // rows of pixels from the top, of each pixel its samples
  std::vector<ReferenceSample> movers;  // as `still`; only where a mover is nearer than what stands still
  std::uint32_t width = 0;
  shape::SamplePattern pattern{};

  // Index of the pixel's first sample.
  std::size_t first_sample(std::uint32_t column, std::uint32_t row) const {
    return (std::size_t{row} * width + column) * static_cast<std::size_t>(pattern.count);
  }
  // Still groups, then moving ones, each in order of their samples.
  std::vector<ReferenceGroup> groups(std::uint32_t column, std::uint32_t row) const;
};

// Draws `frame`; the film's intervals say which segments move.
Reference draw_reference(const wire::PackedFilm& film, std::uint32_t frame);

// The light of a pixel, in the film's colour space, before exposure.
Color resolve_reference(const Reference& reference, const ReferenceShading& shading, std::uint32_t column,
                        std::uint32_t row);

// Rows from the top, as frames have them.
std::vector<std::uint32_t> reference_pixels(const Reference& reference, const ReferenceShading& shading);

// Draws the frame by nodes and by this twin. No pixel is off by more than one level of 255.
void expect_as_reference(const wire::FilmData& film, std::uint32_t frame, int nodes);

}  // namespace mars::test
