// Where the bones of a skin put a mesh's vertices, by linear blend skinning as glTF 2.0 has it (section 3.7.3): a
// vertex goes by the sum of its joints' matrices times their weights, a joint's matrix being that of its node times its
// inverse bind matrix, which Assimp calls a bone's offset. The matrix of the node that has the mesh does not count.
#pragma once

#include <assimp/scene.h>

#include <glm/mat4x4.hpp>
#include <vector>

namespace mars::importer {

// One matrix a vertex, from the mesh's axes to the file's. `joints` are the matrices of the bones' nodes, in the order
// of the bones. Weights are made to add up to 1; a vertex without any goes with the first bone, as in viewers.
std::vector<glm::dmat4> skinned(const aiMesh& mesh, const std::vector<glm::dmat4>& joints);

}  // namespace mars::importer
