// The skin of a segment whose bones stand somewhere: where its points go. The only place on the host where bones are
// blended; nodes do it in single precision (node/geometry/segment_place.h).
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "host/content/modeler/model.h"
#include "node/shape/dual_quaternion.h"
#include "node/wire/film_parts.h"

namespace mars::modeler {

class BentSkin {
 public:
  // `bones`: their T-matrices (bone_matrix in frames.h).
  BentSkin(std::vector<wire::Matrix> bones, wire::Blend blend);

  // The T-matrix of a point. Weights above 0, whose sum is 1, in the order of the bones.
  wire::Matrix matrix_of(std::span<const BoneWeight> point) const;
  wire::Matrix matrix_of(const VertexBones& point) const;
  // Where it is then; `at` lies in the unit cube.
  glm::dvec3 place_of(const Mesh::Place& at, const VertexBones& point) const;
  // Where the Bezier points of a net are then, by stencil; and its patches.
  std::vector<glm::dvec3> means_of(const ControlNet& net) const;
  std::vector<wire::Patch> patches_of(const ControlNet& net) const;

 private:
  std::vector<glm::dvec3> moved(const ControlNet& net) const;

  std::vector<wire::Matrix> bones_;
  std::vector<shape::DualBone<double>> duals_;  // none where the blend is linear
};

// What a point follows most.
std::uint32_t heaviest_bone(const VertexBones& point);
// What the mean of a stencil follows: what the point of it does that weighs most.
const VertexBones& followed_by(const ControlNet& net, std::uint32_t stencil);
const VertexBones& followed_by(const ControlNet&&, std::uint32_t) = delete;

// Where the matrix takes a point.
glm::dvec3 placed(const wire::Matrix& matrix, const Mesh::Place& at);

}  // namespace mars::modeler
