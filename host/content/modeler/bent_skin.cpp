#include "host/content/modeler/bent_skin.h"

#include <utility>

namespace mars::modeler {

BentSkin::BentSkin(std::vector<wire::Matrix> bones, wire::Blend blend) : bones_(std::move(bones)) {
  if (blend == wire::Blend::linear) return;
  for (const wire::Matrix& bone : bones_) duals_.push_back(shape::dual_bone(shape::parts_of(bone)));
}

wire::Matrix BentSkin::matrix_of(std::span<const BoneWeight> point) const {
  wire::Matrix matrix{};
  if (!duals_.empty()) {
    shape::DualBlend<double> blend;
    for (const BoneWeight& each : point) blend.add(duals_[each.bone], each.weight);
    blend.put(matrix.m);
    return matrix;
  }
  for (const BoneWeight& each : point)
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 4; ++c) matrix.m[r][c] += each.weight * bones_[each.bone].m[r][c];
  return matrix;
}

wire::Matrix BentSkin::matrix_of(const VertexBones& point) const {
  BoneWeight bones[kMostBonesOfVertex];
  std::size_t count = 0;
  for (std::size_t i = 0; i < kMostBonesOfVertex; ++i)
    if (point.weight[i] > 0) bones[count++] = {point.bone[i], point.weight[i]};
  return matrix_of(std::span(bones).first(count));
}

glm::dvec3 BentSkin::place_of(const Mesh::Place& at, const VertexBones& point) const {
  return placed(matrix_of(point), at);
}

std::vector<wire::Patch> BentSkin::patches_of(const Shape& shape) const {
  std::vector<wire::Patch> bent = shape.patches;
  for (std::size_t patch = 0; patch < bent.size(); ++patch)
    for (std::size_t number = 0; number < wire::kPatchPoints; ++number) {
      auto& point = bent[patch].points[number];
      const glm::dvec3 place = place_of(point, shape.patch_bones[patch][number]);
      for (int axis = 0; axis < 3; ++axis) point[static_cast<std::size_t>(axis)] = static_cast<float>(place[axis]);
    }
  return bent;
}

glm::dvec3 placed(const wire::Matrix& matrix, const Mesh::Place& at) {
  glm::dvec3 place;
  for (int r = 0; r < 3; ++r) {
    const auto& row = matrix.m[static_cast<std::size_t>(r)];
    place[r] = row[0] * at[0] + row[1] * at[1] + row[2] * at[2] + row[3];
  }
  return place;
}

}  // namespace mars::modeler
