#include "host/content/importer/skin.h"

#include <algorithm>

#include "host/content/importer/assimp_matrix.h"

namespace mars::importer {

std::vector<glm::dmat4> skinned(const aiMesh& mesh, const std::vector<glm::dmat4>& joints) {
  std::vector<glm::dmat4> sums(mesh.mNumVertices, glm::dmat4(0));
  std::vector<double> weights(mesh.mNumVertices, 0);
  const std::size_t bones = std::min<std::size_t>(mesh.mNumBones, joints.size());
  for (std::size_t i = 0; i < bones; ++i) {
    const aiBone& bone = *mesh.mBones[i];
    const glm::dmat4 matrix = joints[i] * dmat4_of(bone.mOffsetMatrix);
    for (unsigned w = 0; w < bone.mNumWeights; ++w) {
      const aiVertexWeight& held = bone.mWeights[w];
      sums[held.mVertexId] += double(held.mWeight) * matrix;
      weights[held.mVertexId] += held.mWeight;
    }
  }
  const glm::dmat4 first = bones > 0 ? joints[0] * dmat4_of(mesh.mBones[0]->mOffsetMatrix) : glm::dmat4(1);
  for (std::size_t v = 0; v < sums.size(); ++v) sums[v] = weights[v] > 0 ? sums[v] / weights[v] : first;
  return sums;
}

}  // namespace mars::importer
