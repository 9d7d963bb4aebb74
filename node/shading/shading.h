// The input and output of shading. Plain structs only: kernels of several instruction sets share them (kernels.h).
#pragma once

#include <cstdint>

#include "node/color/encoding.h"
#include "node/geometry/eye_light.h"
#include "node/geometry/triangle.h"
#include "node/shape/sample_pattern.h"
#include "node/shape/vertices.h"
#include "node/wire/film_parts.h"
#include "node/wire/run.h"

namespace mars::geometry {
class SurfaceView;
}

namespace mars::shading {

// All that shading needs of a frame, in eye space.
struct Shading {
  const geometry::Triangle* triangles;
  const wire::Material* materials;
  const geometry::EyeLight* lights;  // those that cast shadows come last
  std::uint32_t light_count;
  std::uint32_t casting_count;
  shape::Projection projection;
  shape::SamplePattern pattern;  // of the film's pixels
  color::Encoding encoding;
  float background[3];
  wire::AmbientLight ambient;
  float up[3];  // the world's z axis, in eye space
  wire::Fog fog;
  // Of pictures with layers.
  wire::PixelFormat pixels;
  const geometry::SurfaceView* surfaces = nullptr;  // none: no layers
};

// A sample to be shaded, of a line that is known.
struct Fragment {
  std::uint32_t triangle;
  std::uint16_t column;
  std::uint16_t sample;  // its number in the pattern
};

// Light that is not summed up yet, of films where lights cast shadows: how much of each arrives is known later. One
// array a channel.
struct UnsummedLight {
  float* base[3];       // ambient light, and lights that do not cast
  float* fog;           // the share of fog's colour
  float* const* terms;  // three arrays for each light that casts
};

// Columns [first, last); none where last <= first.
struct Extent {
  std::uint32_t first;
  std::uint32_t last;
};

// Samples shaded, and among them those lit by models of highlights and of rough surfaces. Others had their colours.
struct ShadedCounts {
  std::uint64_t samples = 0;
  std::uint64_t highlights = 0;
  std::uint64_t facets = 0;

  ShadedCounts& operator+=(const ShadedCounts& more) {
    samples += more.samples;
    highlights += more.highlights;
    facets += more.facets;
    return *this;
  }
};

// How much shading a line wrote.
struct Shaded {
  std::uint32_t runs;
  std::uint32_t pixels;
  ShadedCounts counts{};
};

// More light is as much as this, and so is what is no number.
inline constexpr float kMostShaded = 1e30f;

// The id of a sample that shows nothing.
inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

}  // namespace mars::shading
