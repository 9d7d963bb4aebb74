#include "host/content/importer/unread_parts.h"

#include <assimp/material.h>
#include <assimp/scene.h>

#include <set>
#include <string_view>

#include "host/content/document/text.h"

namespace mars::importer {
namespace {

struct Counts {
  std::set<std::string> textures;
  std::size_t targets = 0, points = 0, lines = 0, glosses = 0, glows = 0, transparencies = 0;
};

void add_mesh(const aiMesh& mesh, Counts& counts) {
  counts.targets += mesh.mNumAnimMeshes;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    counts.points += mesh.mFaces[i].mNumIndices == 1;
    counts.lines += mesh.mFaces[i].mNumIndices == 2;
  }
}

float number_of(const aiMaterial& material, const char* key, unsigned type, unsigned index, float otherwise) {
  float number = otherwise;
  material.Get(key, type, index, number);
  return number;
}

bool has_color(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
  aiColor3D color(0, 0, 0);
  material.Get(key, type, index, color);
  return !color.IsBlack();
}

// A gloss that roughness does not stand for.
bool shines(const aiMaterial& material) {
  return has_color(material, AI_MATKEY_COLOR_SPECULAR) && number_of(material, AI_MATKEY_ROUGHNESS_FACTOR, -1) < 0;
}

bool is_transparent(const aiMaterial& material) {
  aiColor4D base(1, 1, 1, 1);
  material.Get(AI_MATKEY_BASE_COLOR, base);
  return base.a < 1 || number_of(material, AI_MATKEY_OPACITY, 1) < 1;
}

// Only materials that meshes have: Assimp makes some of its own.
void add_material(const aiMaterial& material, const MaterialReader& materials, Counts& counts) {
  for (int type = aiTextureType_NONE; type <= AI_TEXTURE_TYPE_MAX; ++type)
    for (unsigned i = 0; i < material.GetTextureCount(static_cast<aiTextureType>(type)); ++i) {
      aiString path;
      material.GetTexture(static_cast<aiTextureType>(type), i, &path);
      if (!materials.means().has(path.C_Str()) && !materials.images().has(path.C_Str()))
        counts.textures.insert(path.C_Str());
    }
  if (material.GetName() == aiString(AI_DEFAULT_MATERIAL_NAME) || material.GetName().length == 0) return;
  counts.glosses += shines(material);
  counts.glows += has_color(material, AI_MATKEY_COLOR_EMISSIVE);
  counts.transparencies += is_transparent(material);
}

Counts counts_of(const aiScene& scene, const MaterialReader& reader) {
  Counts counts;
  std::set<unsigned> materials;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    add_mesh(*scene.mMeshes[i], counts);
    materials.insert(scene.mMeshes[i]->mMaterialIndex);
  }
  for (const unsigned number : materials) add_material(*scene.mMaterials[number], reader, counts);
  return counts;
}

}  // namespace

std::vector<std::string> unread_parts(const aiScene& scene, const MaterialReader& materials,
                                      const std::string& set_material, bool in_film) {
  const Counts counts = counts_of(scene, materials);
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, std::string_view one, std::string_view several,
                       const std::string& remedy = "") {
    if (count > 0) parts.push_back(document::counted(count, one, several) + (in_film ? "" : remedy));
  };
  const std::string one_color = " (one colour instead: " + set_material + " --color 0.8 0.6 0.4)";
  if (!in_film) add(scene.mNumAnimations, "animation", "animations", " (--as film shows one)");
  add(counts.targets, "morph target", "morph targets");
  add(counts.textures.size(), "texture", "textures", one_color);
  add(counts.glosses, "material's gloss", "materials' gloss", " (" + set_material + " --specular 0.3)");
  add(counts.glows, "material's glow", "materials' glow");
  add(counts.transparencies, "material's transparency", "materials' transparency");
  add(counts.points, "point", "points");
  add(counts.lines, "line", "lines");
  if (in_film) return parts;
  add(scene.mNumCameras, "camera", "cameras", " (--as film shows what one sees)");
  add(scene.mNumLights, "light", "lights", " (--as film has them)");
  return parts;
}

}  // namespace mars::importer
