#include "host/content/film/shape_writer.h"

#include <algorithm>
#include <limits>
#include <span>

#include "hal/failure/failure.h"
#include "host/content/modeler/meshlets.h"

namespace mars::film {
namespace {

constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();  // of vertices, triangles or weights

template <typename Item>
void append(std::vector<Item>& items, const std::vector<Item>& more) {
  items.insert(items.end(), more.begin(), more.end());
}

std::string_view bits_of(const std::vector<wire::Patch>& patches) {
  return {reinterpret_cast<const char*>(patches.data()), patches.size() * sizeof(wire::Patch)};
}

// By stencil, the bones that its points follow, ascending.
std::vector<std::vector<std::uint32_t>> bones_of_stencils(const modeler::ControlNet& net) {
  std::vector<std::vector<std::uint32_t>> bones;
  std::vector<modeler::VertexBones> points;
  for (const wire::Stencil& stencil : net.stencils) {
    points.clear();
    for (const wire::StencilTerm& term : net.terms_of(stencil)) points.push_back(net.bones[term.point]);
    bones.push_back(modeler::all_bones(points));
  }
  return bones;
}

std::vector<std::uint32_t> joined(std::span<const std::vector<std::uint32_t>> of_stencils,
                                  const wire::PatchStencils& patch) {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t stencil : patch) append(all, of_stencils[stencil]);
  std::ranges::sort(all);
  const auto again = std::ranges::unique(all);
  all.erase(again.begin(), again.end());
  return all;
}

std::uint32_t bone_count(const modeler::SkinLists& lists) {
  return lists.bones.empty() ? 0 : *std::ranges::max_element(lists.bones) + 1;
}

}  // namespace

std::uint32_t ShapeWriter::add(const modeler::Shape& shape) {
  if (shape.mesh) return add_mesh(*shape.mesh);
  return shape.net ? add_net(shape) : add_patches(shape.patches);
}

std::uint32_t ShapeWriter::add_net(const modeler::Shape& shape) {
  const modeler::ControlNet& net = *shape.net;
  for (const auto& [known, number] : of_nets_)
    if (*known == net) return number;
  if (film_.stencil_terms.size() + net.terms.size() > kMost)
    throw Failure("have more than 4294967295 terms of stencils", "skins", "use fewer or smaller skins");
  const auto points = static_cast<std::uint32_t>(film_.net_points.size()),
             terms = static_cast<std::uint32_t>(film_.stencil_terms.size()),
             stencils = static_cast<std::uint32_t>(film_.stencils.size());
  modeler::SkinLists lists;
  for (std::size_t i = 0; i < net.points.size(); ++i)
    film_.net_points.push_back({net.points[i], placed(lists.add(std::span(&net.bones[i], 1)))});
  for (const wire::StencilTerm& term : net.terms) film_.stencil_terms.push_back({points + term.point, term.weight});
  for (const wire::Stencil& stencil : net.stencils)
    film_.stencils.push_back({terms + stencil.first_term, stencil.term_count});
  film_.shapes.push_back({std::uint32_t(film_.patches.size()), std::uint32_t(shape.patches.size()), 0, 0,
                          bone_count(lists), std::uint32_t(film_.net_patches.size())});
  append(film_.patches, shape.patches);
  const auto of_stencils = bones_of_stencils(net);
  for (const wire::PatchStencils& patch : net.patches) {
    wire::NetPatch& added = film_.net_patches.emplace_back(wire::NetPatch{patch});
    for (std::uint32_t& number : added.stencils) number += stencils;
    const wire::Skin bones = placed(lists.add_bones(joined(of_stencils, patch)));
    added.first_bone = bones.first_bone, added.bone_count = bones.bone_count;
  }
  append_lists(lists);
  return of_nets_.emplace_back(&net, std::uint32_t(film_.shapes.size() - 1)).second;
}

// Behind those that the film has.
wire::Skin ShapeWriter::placed(wire::Skin skin) const {
  skin.first_bone += static_cast<std::uint32_t>(film_.skin_bones.size());
  skin.first_weight += static_cast<std::uint32_t>(film_.skin_weights.size());
  return skin;
}

void ShapeWriter::append_lists(const modeler::SkinLists& lists) {
  if (film_.skin_weights.size() + lists.weights.size() > kMost || film_.skin_bones.size() + lists.bones.size() > kMost)
    throw Failure("have more than 4294967295 weights", "skins", "use fewer or smaller skins");
  append(film_.skin_bones, lists.bones);
  append(film_.skin_weights, lists.weights);
}

std::uint32_t ShapeWriter::add_patches(const std::vector<wire::Patch>& patches) {
  const auto [known, is_new] = of_patches_.try_emplace(bits_of(patches), film_.shapes.size());
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
  if (vertices + cut.places.size() > kMost || triangles + cut.triangles.size() > kMost)
    throw Failure("have more than 4294967295 vertices or triangles", "meshes", "use fewer or smaller meshes");
  for (wire::Meshlet& meshlet : cut.meshlets) {
    meshlet.first_vertex += static_cast<std::uint32_t>(vertices);
    meshlet.first_triangle += static_cast<std::uint32_t>(triangles);
    meshlet.skin = placed(meshlet.skin);
  }
  const auto number = static_cast<std::uint32_t>(film_.shapes.size());
  film_.shapes.push_back(
      {0, 0, std::uint32_t(film_.meshlets.size()), std::uint32_t(cut.meshlets.size()), bone_count(cut.skins)});
  append(film_.mesh_places, cut.places);
  append(film_.mesh_normals, cut.normals);
  append(film_.mesh_triangles, cut.triangles);
  append(film_.meshlets, cut.meshlets);
  append_lists(cut.skins);
  of_meshes_.emplace_back(&mesh, number);
  return number;
}

}  // namespace mars::film
