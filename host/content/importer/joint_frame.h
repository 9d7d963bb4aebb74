// Where a joint stands and which way its axes run.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace mars::importer {

struct JointFrame {
  glm::dvec3 origin{0};  // in the model's frame, as the axes
  glm::dvec3 x_axis{1, 0, 0}, y_axis{0, 1, 0};

  // As a model's reader makes them: unit axes x and y, z along x cross y.
  glm::dmat3 axes() const;
};

// Of a node whose matrix in the model's frame is `matrix`: its x axis, and of its y axis what is perpendicular to that,
// with six digits; of a node that flattens them, the model's axes. Scale, shear and mirror are not the frame's: they
// stay with the mesh (within_frame()).
JointFrame frame_of(const glm::dmat4& matrix);

// What is left of a node's matrix in its frame: from the mesh's axes to the joint's. Meshes of one shape come out equal
// however their nodes are turned.
glm::dmat3 within_frame(const JointFrame& frame, const glm::dmat3& linear);

// Whether the matrix scales all directions alike, so that what turns below it keeps its shape.
bool scales_evenly(const glm::dmat4& matrix);

}  // namespace mars::importer
