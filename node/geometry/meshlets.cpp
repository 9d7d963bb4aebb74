#include "node/geometry/meshlets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mars::geometry {
namespace {

constexpr int kMostBatches =
    static_cast<int>((wire::kMeshletTriangles + shape::kBatchTriangles - 1) / shape::kBatchTriangles);
static_assert(wire::kMeshSlack >= simd::kVectorSlack);

const float (*vectors(const std::array<float, 3>* first))[3] { return reinterpret_cast<const float(*)[3]>(first); }

}  // namespace

// The cofactors are scaled so that the largest is 1: squares of what they turn stay far inside a float, however small
// or large the mesh is shown.
shape::EyeMap eye_map(const shape::EyeMatrix& matrix) {
  shape::EyeMap map;
  double cofactor[3][3], largest = 0;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const float *one = matrix.m[(r + 1) % 3], *other = matrix.m[(r + 2) % 3];
      const int next = (c + 1) % 3, last = (c + 2) % 3;
      cofactor[r][c] = static_cast<double>(one[next]) * other[last] - static_cast<double>(one[last]) * other[next];
      largest = std::max(largest, std::abs(cofactor[r][c]));
    }
  for (int r = 0; r < 3; ++r) {
    std::copy_n(matrix.m[r], 4, map.place[r]);
    for (int c = 0; c < 3; ++c) map.normal[r][c] = largest > 0 ? static_cast<float>(cofactor[r][c] / largest) : 0.0f;
  }
  return map;
}

bool unseen(const shape::EyeMatrix& matrix, const wire::Meshlet& meshlet, const shape::Projection& projection,
            float width, float height) {
  float corners[8][3];
  for (int k = 0; k < 8; ++k) {
    const auto along = [&](std::size_t axis) { return (k >> axis & 1 ? meshlet.high : meshlet.low)[axis]; };
    shape::to_eye(matrix, {along(0), along(1), along(2)}, corners[k]);
  }
  return shape::unseen(corners, 8, projection, width, height);
}

MeshletPlacer::MeshletPlacer(simd::InstructionSet set)
    : shape::Surface(set, static_cast<int>(wire::kMeshletVertices), static_cast<int>(wire::kMeshletTriangles),
                     kMostBatches) {}

void MeshletPlacer::place(const shape::EyeMap& map, const wire::PackedFilm& film, const wire::Meshlet& meshlet,
                          const shape::Projection& projection) {
  vertex_count_ = static_cast<int>(meshlet.vertex_count);
  kernels_.move(map, vectors(film.mesh_places().data() + meshlet.first_vertex),
                vectors(film.mesh_normals().data() + meshlet.first_vertex), vertex_count_, vertices_);
  project(projection);
  clear_triangles();
  for (const wire::MeshTriangle& t : film.mesh_triangles().subspan(meshlet.first_triangle, meshlet.triangle_count))
    add(t[0], t[1], t[2]);
  end_batches(false);
}

}  // namespace mars::geometry
