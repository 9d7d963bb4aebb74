#include "host/content/importer/scenes/scene_nodes.h"

#include <glm/matrix.hpp>
#include <optional>

#include "hal/failure/failure.h"
#include "host/content/importer/assimp_matrix.h"
#include "host/content/modeler/joint.h"

namespace mars::importer {
namespace {

constexpr double kMetre = 100;  // centimetres, FBX's unit

void add(const std::filesystem::path& path, const aiNode& node, std::size_t parent, SceneNodes& all) {
  if (all.nodes.size() == kMostNodes)
    throw Failure("has more than a million nodes", path.string(), "join its objects before exporting it");
  const std::size_t number = all.nodes.size();
  all.nodes.push_back(&node);
  all.parents.push_back(parent);
  all.numbers.try_emplace(node.mName.C_Str(), number);
  for (unsigned i = 0; i < node.mNumChildren; ++i) add(path, *node.mChildren[i], number, all);
}

// The file's axis that `key` names, with its sign.
std::optional<glm::dvec3> axis_of(const aiMetadata& data, const std::string& key) {
  std::int32_t axis = -1, sign = 1;
  if (!data.Get(key, axis) || axis < 0 || axis > 2) return std::nullopt;
  data.Get(key + "Sign", sign);
  glm::dvec3 vector(0);
  vector[axis] = sign < 0 ? -1 : 1;
  return vector;
}

// From FBX's axes to x to the right, y up, z to the front; unturned where they are none that turn into these.
glm::dmat3 upright(const aiMetadata& data) {
  const auto right = axis_of(data, "CoordAxis"), up = axis_of(data, "UpAxis"), front = axis_of(data, "FrontAxis");
  if (!right || !up || !front) return glm::dmat3(1);
  const glm::dmat3 turn = glm::transpose(glm::dmat3(*right, *up, *front));
  return glm::determinant(turn) > 0 ? turn : glm::dmat3(1);
}

double metres(const aiMetadata& data) {
  float centimetres = 0;
  return data.Get("UnitScaleFactor", centimetres) && centimetres > 0 ? double(centimetres) / kMetre : 1 / kMetre;
}

// Of FBX; Assimp turns and scales COLLADA's root itself.
glm::dmat4 to_metres(const aiScene& scene) {
  if (scene.mMetaData == nullptr || !scene.mMetaData->HasKey("UpAxis")) return glm::dmat4(1);
  return glm::dmat4(upright(*scene.mMetaData) * metres(*scene.mMetaData));
}

std::vector<std::size_t> bones_of(const aiMesh& mesh, const SceneNodes& nodes) {
  std::vector<std::size_t> bones;
  for (unsigned i = 0; i < mesh.mNumBones; ++i) {
    const auto found = nodes.numbers.find(mesh.mBones[i]->mName.C_Str());
    bones.push_back(found == nodes.numbers.end() ? 0 : found->second);
  }
  return bones;
}

}  // namespace

bool is_pivot(const std::string& name) { return name.find(kPivot) != std::string::npos; }

SceneNodes scene_nodes(const std::filesystem::path& path, const aiScene& scene) {
  SceneNodes nodes;
  add(path, *scene.mRootNode, modeler::kNone, nodes);
  nodes.root = to_metres(scene) * dmat4_of(scene.mRootNode->mTransformation);
  return nodes;
}

GltfSkins scene_skins(const aiScene& scene, const SceneNodes& nodes) {
  GltfSkins all{{}, {}, {}, nodes.root, true};
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) all.skins.push_back(bones_of(*scene.mMeshes[i], nodes));
  for (std::size_t number = 0; number < nodes.nodes.size(); ++number) {
    const aiNode& node = *nodes.nodes[number];
    all.nodes.push_back({node.mName.C_Str(), {}, {}});
    for (unsigned i = node.mNumMeshes; i-- > 0;)
      if (scene.mMeshes[node.mMeshes[i]]->HasBones()) all.nodes.back().skin = node.mMeshes[i];
    if (number > 0) all.nodes[nodes.parents[number]].children.push_back(number);
  }
  all.roots = scene.mRootNode->mNumMeshes > 0 ? std::vector<std::size_t>{0} : all.nodes[0].children;
  return all;
}

}  // namespace mars::importer
