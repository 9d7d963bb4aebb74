// The bones that a mesh's vertices follow, by linear blend skinning as glTF 2.0 has it (section 3.7.3): a vertex goes
// by the sum of its joints' matrices times their weights, a joint's matrix being that of its node times its inverse
// bind matrix, which Assimp calls a bone's offset. The matrix of the node that has the mesh does not count.
#pragma once

#include <assimp/scene.h>

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <vector>

#include "host/content/modeler/mesh.h"

namespace mars::importer {

struct MeshSkin {
  std::vector<glm::dmat4> to_file;             // of each bone that the mesh has: from the mesh's axes to the file's
  std::vector<modeler::VertexBones> vertices;  // numbers in to_file
  std::size_t heaviest = 0;                    // the bone whose weights, of all vertices, are most
  std::size_t weights_left_out = 0;            // of vertices that follow more bones than a model's may
  std::size_t boneless = 0;                    // vertices without any weight
};

// `joints` are the matrices of the bones' nodes, in the order of the bones. A vertex without any weight goes with the
// first bone, as in viewers.
MeshSkin skin_of(const aiMesh& mesh, const std::vector<glm::dmat4>& joints);

}  // namespace mars::importer
