// Assimp's matrices and vectors as GLM's.
#pragma once

#include <assimp/types.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace mars::importer {

inline glm::dvec3 dvec3_of(const aiVector3D& vector) { return {vector.x, vector.y, vector.z}; }

// Assimp names rows by letters, GLM has columns.
inline glm::dmat4 dmat4_of(const aiMatrix4x4& m) {
  return {{m.a1, m.b1, m.c1, m.d1}, {m.a2, m.b2, m.c2, m.d2}, {m.a3, m.b3, m.c3, m.d3}, {m.a4, m.b4, m.c4, m.d4}};
}

}  // namespace mars::importer
