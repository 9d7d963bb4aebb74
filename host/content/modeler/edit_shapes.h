// Steps that change the shapes of a model's JSON by their control points: those of patches and of B-spline surfaces.
// Like the steps of edit.h.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "host/content/document/json_file.h"
#include "host/content/modeler/model.h"

namespace mars::modeler {

// A point of a shape's patch: (i along u, j along v), 0 to 3. A B-spline surface is one patch of as many points as its
// rows and columns have.
struct ControlPoint {
  std::size_t patch;
  std::array<std::size_t, 2> at;
  glm::dvec3 place;  // in the unit cube
};

// Those of the joint's shape; none where it is a mesh, or the joint has no segment. `meaning` is what `model` is read
// as.
std::vector<ControlPoint> control_points(const document::Json& model, const Model& meaning, const std::string& joint);

// Moves the point to `point.place`, held within the unit cube, and with it all others of the shape that are in the same
// place, so that neighbours stay together. A shape of the library becomes the model's own first, for this joint alone;
// returns its name then, else "".
std::string set_point(document::Json& model, const Model& meaning, const std::string& joint, const ControlPoint& point);

}  // namespace mars::modeler
