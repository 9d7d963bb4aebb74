#include "host/content/importer/gltf_skins.h"

#include <map>
#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"

namespace mars::importer {
namespace {

std::string name_of(const Tree& named) {
  const Tree& name = at(named, "name");
  return name.is_string() ? name.get<std::string>() : "";
}

// Assimp crashes where a skin has no matrices, reads beyond the last where these are too few, and gives a mesh under
// two skins the bones of one.
void refuse_skin(const std::filesystem::path& path, const Tree& gltf, const Tree& node,
                 std::map<std::size_t, Tree>& skin_of_mesh) {
  const Tree& skin = item(at(gltf, "skins"), at(node, "skin"));
  const Tree& matrices = at(skin, "inverseBindMatrices");
  const Tree& accessor = item(at(gltf, "accessors"), matrices);
  if (accessor.is_null())
    throw Failure("has a skin without inverse bind matrices", path.string(), "export it with them, as Blender does");
  if (at(accessor, "type") != "MAT4" || number(at(accessor, "componentType"), 0) != kFloatType ||
      number(at(accessor, "count"), 0) < at(skin, "joints").size())
    throw Failure("has a skin with fewer inverse bind matrices than joints", path.string(), "export it again");
  const Tree& mesh = at(node, "mesh");
  const auto [other, is_new] = skin_of_mesh.try_emplace(number(mesh, 0), matrices);
  if (!is_new && other->second != matrices)
    throw Failure("has a mesh under two skins", path.string(), "export a mesh of its own for each skin");
}

}  // namespace

GltfSkins gltf_skins(const std::filesystem::path& path, const Tree& gltf) {
  GltfSkins all{{}, root_nodes(gltf), {}, glm::dmat4(1), false};
  std::map<std::size_t, Tree> skin_of_mesh;
  const Tree &nodes = at(gltf, "nodes"), &skins = at(gltf, "skins");
  for (const Tree& skin : skins) all.skins.push_back(places_in(nodes, at(skin, "joints")));
  for (const Tree& node : nodes) {
    const Tree& mesh = item(at(gltf, "meshes"), at(node, "mesh"));
    std::string name = name_of(node);
    all.nodes.push_back({name.empty() ? name_of(mesh) : name, places_in(nodes, at(node, "children")), {}});
    if (mesh.is_null() || item(skins, at(node, "skin")).is_null()) continue;
    refuse_skin(path, gltf, node, skin_of_mesh);
    all.nodes.back().skin = number(at(node, "skin"), 0);
  }
  return all;
}

}  // namespace mars::importer
