#include "host/content/importer/skin.h"

#include <algorithm>
#include <cmath>

#include "host/content/importer/assimp_matrix.h"

namespace mars::importer {

MeshSkin skin_of(const aiMesh& mesh, const std::vector<glm::dmat4>& joints) {
  MeshSkin skin;
  std::vector<std::vector<modeler::BoneWeight>> followed(mesh.mNumVertices);
  std::vector<double> weights(std::max<std::size_t>(1, std::min<std::size_t>(mesh.mNumBones, joints.size())), 0);
  for (std::uint32_t bone = 0; bone < mesh.mNumBones && bone < joints.size(); ++bone) {
    skin.to_file.push_back(joints[bone] * dmat4_of(mesh.mBones[bone]->mOffsetMatrix));
    for (unsigned w = 0; w < mesh.mBones[bone]->mNumWeights; ++w) {
      const aiVertexWeight& held = mesh.mBones[bone]->mWeights[w];
      if (!(held.mWeight > 0) || !std::isfinite(held.mWeight)) continue;
      followed[held.mVertexId].push_back({bone, held.mWeight});
      weights[bone] += held.mWeight;
    }
  }
  if (skin.to_file.empty()) skin.to_file.emplace_back(1);
  for (std::vector<modeler::BoneWeight>& bones : followed) {
    if (bones.size() > modeler::kMostBonesOfVertex) skin.weights_left_out += bones.size() - modeler::kMostBonesOfVertex;
    const auto bones_of_vertex = modeler::bones_of_vertex(std::move(bones));
    skin.boneless += !bones_of_vertex;
    skin.vertices.push_back(bones_of_vertex.value_or(modeler::VertexBones{{0}, {1}}));
  }
  skin.heaviest = static_cast<std::size_t>(std::ranges::max_element(weights) - weights.begin());
  return skin;
}

}  // namespace mars::importer
