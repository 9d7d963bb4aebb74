#include "host/content/film/shape_writer.h"

#include <algorithm>
#include <limits>

#include "hal/failure/failure.h"
#include "host/content/modeler/meshlets.h"

namespace mars::film {
namespace {

constexpr std::size_t kMostOfMeshes =
    std::numeric_limits<std::uint32_t>::max();  // of vertices or triangles of all meshes

template <typename Item>
void append(std::vector<Item>& items, const std::vector<Item>& more) {
  items.insert(items.end(), more.begin(), more.end());
}

}  // namespace

std::uint32_t ShapeWriter::add(const modeler::Shape& shape) {
  return shape.mesh ? add_mesh(*shape.mesh) : add_patches(shape.patches);
}

std::uint32_t ShapeWriter::add_patches(const std::vector<wire::Patch>& patches) {
  const std::string_view bits(reinterpret_cast<const char*>(patches.data()), patches.size() * sizeof(wire::Patch));
  const auto [known, is_new] = of_patches_.try_emplace(bits, film_.shapes.size());
  if (is_new) {
    film_.shapes.push_back({std::uint32_t(film_.patches.size()), std::uint32_t(patches.size())});
    append(film_.patches, patches);
  }
  return known->second;
}

std::uint32_t ShapeWriter::add_mesh(const modeler::Mesh& mesh) {
  for (const auto& [known, number] : of_meshes_)
    if (*known == mesh) return number;
  modeler::Meshlets cut = modeler::cut_meshlets(mesh);
  const std::size_t vertices = film_.mesh_places.size(), triangles = film_.mesh_triangles.size();
  const std::size_t bones = film_.mesh_bones.size(), weights = film_.mesh_weights.size();
  if (vertices + cut.places.size() > kMostOfMeshes || triangles + cut.triangles.size() > kMostOfMeshes ||
      weights + cut.weights.size() > kMostOfMeshes)
    throw Failure("have more than 4294967295 vertices, triangles or weights", "meshes", "use fewer or smaller meshes");
  for (wire::Meshlet& meshlet : cut.meshlets) {
    meshlet.first_vertex += static_cast<std::uint32_t>(vertices);
    meshlet.first_triangle += static_cast<std::uint32_t>(triangles);
    meshlet.first_bone += static_cast<std::uint32_t>(bones);
    meshlet.first_weight += static_cast<std::uint32_t>(weights);
  }
  const auto number = static_cast<std::uint32_t>(film_.shapes.size());
  film_.shapes.push_back({0, 0, std::uint32_t(film_.meshlets.size()), std::uint32_t(cut.meshlets.size()),
                          cut.bones.empty() ? 0 : *std::ranges::max_element(cut.bones) + 1});
  append(film_.mesh_places, cut.places);
  append(film_.mesh_normals, cut.normals);
  append(film_.mesh_triangles, cut.triangles);
  append(film_.mesh_bones, cut.bones);
  append(film_.mesh_weights, cut.weights);
  append(film_.meshlets, cut.meshlets);
  of_meshes_.emplace_back(&mesh, number);
  return number;
}

}  // namespace mars::film
