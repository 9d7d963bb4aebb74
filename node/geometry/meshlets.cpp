#include "node/geometry/meshlets.h"

#include <array>
#include <cstddef>
#include <cstring>

namespace mars::geometry {
namespace {

constexpr int kMostBatches =
    static_cast<int>((wire::kMeshletTriangles + shape::kBatchTriangles - 1) / shape::kBatchTriangles);
static_assert(wire::kMeshSlack >= simd::kVectorSlack);

const float (*vectors(const std::array<float, 3>* first))[3] { return reinterpret_cast<const float(*)[3]>(first); }

}  // namespace

MeshletPlacer::MeshletPlacer(simd::InstructionSet set)
    : shape::Surface(set, static_cast<int>(wire::kMeshletVertices), static_cast<int>(wire::kMeshletTriangles),
                     kMostBatches) {}

void MeshletPlacer::place(const SegmentPlace& segment, const wire::PackedFilm& film, const wire::Meshlet& meshlet,
                          const shape::Projection& projection) {
  if (!segment.has_skin()) return place(segment.map(), film, meshlet, projection);
  const bool is_dual = !segment.duals().empty();
  float bones[wire::kMeshletBones][3][4];
  shape::DualBone<float> duals[wire::kMeshletBones];
  int count = 0;
  for (const std::uint32_t bone : film.bones_of(meshlet.skin)) {
    std::memcpy(bones[count], segment.bones()[bone].m, sizeof bones[0]);
    if (is_dual) duals[count] = segment.duals()[bone];
    ++count;
  }
  const shape::EyeSkin skin{bones, is_dual ? duals : nullptr, film.skin_weights().data() + meshlet.skin.first_weight,
                            count, segment.scale(film, meshlet)};
  vertex_count_ = static_cast<int>(meshlet.vertex_count);
  kernels_.move_skin(skin, vectors(film.mesh_places().data() + meshlet.first_vertex),
                     vectors(film.mesh_normals().data() + meshlet.first_vertex), vertex_count_, vertices_);
  finish(film, meshlet, projection);
}

void MeshletPlacer::place(const shape::EyeMap& map, const wire::PackedFilm& film, const wire::Meshlet& meshlet,
                          const shape::Projection& projection) {
  vertex_count_ = static_cast<int>(meshlet.vertex_count);
  kernels_.move(map, vectors(film.mesh_places().data() + meshlet.first_vertex),
                vectors(film.mesh_normals().data() + meshlet.first_vertex), vertex_count_, vertices_);
  finish(film, meshlet, projection);
}

void MeshletPlacer::finish(const wire::PackedFilm& film, const wire::Meshlet& meshlet,
                           const shape::Projection& projection) {
  project(projection);
  clear_triangles();
  for (const wire::MeshTriangle& t : film.mesh_triangles().subspan(meshlet.first_triangle, meshlet.triangle_count))
    add(t[0], t[1], t[2]);
  end_batches(false);
}

}  // namespace mars::geometry
