// A figure's surface as it stands, and which points of it which joints move.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "host/content/animator/motion/body/posture.h"

namespace mars::motion {

struct SurfacePoint {
  glm::dvec3 place;     // in the world
  std::size_t joint;    // that moves it; of a skin the one that the point follows most
  std::size_t segment;  // the joint whose segment it belongs to
};

struct Surface {
  std::vector<SurfacePoint> points;
  std::vector<modeler::Mesh::Triangle> triangles;
};

inline constexpr int kCoarseGrid = 4;  // points along each side of a patch, of which the shape of soles is known

// With joints in these frames. Patches give `grid` points along each side, 2 or more.
Surface surface_of(const modeler::Model& model, const std::function<modeler::Axes(std::size_t joint)>& frame_of,
                   int grid);

// In the world: of the segments of joints for which `counts(joint)` holds, and of skins the vertices that follow such a
// joint more than any other. Patches give a few points each.
std::vector<glm::dvec3> points_of(const modeler::Model& model, const Posture& posture,
                                  const std::function<bool(std::size_t joint)>& counts);

// How far the vertices of skins that follow these joints more than any other reach from the joint `from`, drawn, along
// a direction of the model's axes; 0 where there are none.
double reach_of_skin(const modeler::Model& model, std::size_t from, const glm::dvec3& direction,
                     const std::function<bool(std::size_t joint)>& counts);

}  // namespace mars::motion
