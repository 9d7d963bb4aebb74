// Shadows of a film's first frame, pair by pair: as a node's ShadowCaster finds them, and the triangles that throw
// them. Samples come from the plain renderer (reference.h).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "node/geometry/scene.h"
#include "node/shadow/shadow_caster.h"
#include "tests/node/shape/patches.h"
#include "tests/render/film_run.h"
#include "tests/render/reference.h"

namespace mars::test {

// Triangles of one patch or meshlet, in eye space.
struct CastingSurface {
  std::vector<std::array<shape::Vec3, 3>> triangles;
};

// A pair of a pixel whose sample shows something.
struct Pair {
  std::uint32_t light;  // number of the casting light
  std::uint32_t column, row, number;
  std::size_t triangle;  // of the reference
  double w;              // of the point, along the view axis
  shape::Vec3 place;     // in eye space
  std::uint32_t light_point;
  bool blocked;
};

class ShadowRig {
 public:
  explicit ShadowRig(const wire::FilmData& film, std::string_view simd = "");

  const geometry::Scene& scene() const { return scene_; }
  const Reference& reference() const { return reference_; }
  shadow::LightViews views(std::uint32_t light) const;
  // Of each light, what stands still, then movers.
  std::vector<Pair> pairs() const;
  // All that casts, still and moving, diced here.
  std::vector<CastingSurface> surfaces() const;

 private:
  // Samples of one kind.
  struct Samples {
    std::vector<float> depth;
    std::vector<wire::StillPairs> pairs;
    std::vector<std::uint16_t> moved;
    shadow::Layer layer;
  };

  void lay_out(const std::vector<ReferenceSample>& from, Samples& to) const;
  void add_pairs(const std::vector<ReferenceSample>& from, const Samples& samples, std::uint32_t light,
                 std::vector<Pair>& out) const;

  FilmBlock block_;
  geometry::Scene scene_;
  Reference reference_;
  Samples still_, movers_;
};

}  // namespace mars::test
