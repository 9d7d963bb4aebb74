// The surface of an actor as it stands at a frame, for hands that touch it.
#pragma once

#include <array>
#include <vector>

#include "host/content/animator/pose/film.h"

namespace mars::motion {

class Solid {
 public:
  // In the frame `seen_from`, such as a hand's. The actor is moved by keys.
  Solid(const animator::Film& film, std::size_t actor, std::uint32_t frame, const modeler::Axes& seen_from);

  // From a place to the nearest point of the surface; 1e300 where there is none.
  double distance(const glm::dvec3& from) const;
  // Whether the surface is around the place.
  bool holds(const glm::dvec3& place) const;

 private:
  using Triangle = std::array<glm::dvec3, 3>;

  // Neighbours, and a ball around them.
  struct Patch {
    std::vector<Triangle> triangles;
    glm::dvec3 middle;
    double radius;
  };

  std::vector<Patch> patches_;
  glm::dvec3 low_{1e300}, high_{-1e300};  // of the box round all
};

}  // namespace mars::motion
