// One meshlet of a polygon mesh at a time, as the film has it, becomes a surface: moved to eye space and projected.
#pragma once

#include "node/shape/bezier.h"
#include "node/shape/surface.h"
#include "node/wire/film.h"

namespace mars::geometry {

// How `matrix` moves places and turns normals.
shape::EyeMap eye_map(const shape::EyeMatrix& matrix);

// Whether the meshlet surely leaves no mark on a picture of width x height: its box lies outside.
bool unseen(const shape::EyeMatrix& matrix, const wire::Meshlet& meshlet, const shape::Projection& projection,
            float width, float height);

class MeshletPlacer : public shape::Surface {
 public:
  explicit MeshletPlacer(simd::InstructionSet set);

  // Becomes the surface of `meshlet`, until the next call.
  void place(const shape::EyeMap& map, const wire::PackedFilm& film, const wire::Meshlet& meshlet,
             const shape::Projection& projection);
};

}  // namespace mars::geometry
