#include "host/content/modeler/bent_skin.h"

#include <algorithm>
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

std::vector<glm::dvec3> BentSkin::moved(const ControlNet& net) const {
  std::vector<glm::dvec3> places;
  for (std::size_t point = 0; point < net.points.size(); ++point)
    places.push_back(place_of(net.points[point], net.bones[point]));
  return places;
}

std::vector<glm::dvec3> BentSkin::means_of(const ControlNet& net) const { return modeler::means_of(net, moved(net)); }

std::vector<wire::Patch> BentSkin::patches_of(const ControlNet& net) const {
  return modeler::patches_of(net, moved(net));
}

std::uint32_t heaviest_bone(const VertexBones& point) {
  return point.bone[static_cast<std::size_t>(std::ranges::max_element(point.weight) - point.weight.begin())];
}

const VertexBones& followed_by(const ControlNet& net, std::uint32_t stencil) {
  const auto terms = net.terms_of(net.stencils[stencil]);
  return net.bones[std::ranges::max_element(terms, {}, &wire::StencilTerm::weight)->point];
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
