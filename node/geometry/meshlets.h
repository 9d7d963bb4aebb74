// One meshlet of a polygon mesh at a time, as the film has it, becomes a surface: moved to eye space and projected.
#pragma once

#include "node/geometry/segment_place.h"
#include "node/shape/surface.h"
#include "node/wire/film.h"

namespace mars::geometry {

class MeshletPlacer : public shape::Surface {
 public:
  explicit MeshletPlacer(simd::InstructionSet set);

  // Becomes the surface of `meshlet`, which is one of its segment's shape, until the next call.
  void place(const SegmentPlace& segment, const wire::PackedFilm& film, const wire::Meshlet& meshlet,
             const shape::Projection& projection);
  // The same of a rigid one.
  void place(const shape::EyeMap& map, const wire::PackedFilm& film, const wire::Meshlet& meshlet,
             const shape::Projection& projection);

 private:
  void finish(const wire::PackedFilm& film, const wire::Meshlet& meshlet, const shape::Projection& projection);
};

}  // namespace mars::geometry
