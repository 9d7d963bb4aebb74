// One meshlet of a polygon mesh at a time, as the film has it, becomes a surface: moved to eye space and projected.
#pragma once

#include "node/shape/bezier.h"
#include "node/shape/surface.h"
#include "node/wire/film.h"

namespace mars::node {

EyeMap eye_map(const EyeMatrix& matrix);

// Whether the meshlet surely leaves no mark on a picture of width x height: its box lies outside.
bool unseen(const EyeMatrix& matrix, const Meshlet& meshlet, const Projection& projection, float width, float height);

class MeshletPlacer : public Surface {
 public:
  explicit MeshletPlacer(InstructionSet set);

  // Becomes the surface of `meshlet`, until the next call.
  void place(const EyeMap& map, const FilmView& film, const Meshlet& meshlet, const Projection& projection);
};

}  // namespace mars::node
