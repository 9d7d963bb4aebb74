#include "host/content/importer/material_reader.h"

#include <assimp/material.h>

#include <algorithm>
#include <cmath>

#include "host/content/document/shown_color.h"

namespace mars::importer {
namespace {

std::optional<float> number_of(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
  float number = 0;
  return material.Get(key, type, index, number) == AI_SUCCESS ? std::optional(number) : std::nullopt;
}

double within_one(double number) { return number >= 0 ? std::min(number, 1.0) : 0; }

double rounded(double number) { return std::round(number * 1000) / 1000; }

}  // namespace

// Assimp puts a material of its own behind those of a glTF file, for meshes without one.
bool MaterialReader::is_given(const aiMesh& mesh) const {
  if (kind_ == FileKind::stl) return false;
  if (is_gltf(kind_)) return mesh.mMaterialIndex + 1 < scene_.mNumMaterials;
  return scene_.mMaterials[mesh.mMaterialIndex]->GetName() != aiString(AI_DEFAULT_MATERIAL_NAME);
}

std::optional<std::size_t> MaterialReader::number_of(const aiMesh& mesh) {
  if (!is_given(mesh)) return {};
  const auto [known, is_new] = numbers_.try_emplace(mesh.mMaterialIndex);
  if (!is_new) return known->second;
  const std::optional<ImportedMaterial> material = read(*scene_.mMaterials[mesh.mMaterialIndex]);
  if (!material) return {};
  const auto same = std::ranges::find(materials_, *material);
  if (same == materials_.end()) materials_.push_back(*material);
  return known->second = static_cast<std::size_t>(std::ranges::find(materials_, *material) - materials_.begin());
}

// The extension of specular and glossy materials has a diffuse colour of its own.
std::optional<ImportedMaterial> MaterialReader::read(const aiMaterial& material) {
  const bool glossy = is_gltf(kind_) && importer::number_of(material, AI_MATKEY_GLOSSINESS_FACTOR);
  aiColor4D given;
  if (!glossy && material.Get(AI_MATKEY_BASE_COLOR, given) == AI_SUCCESS)
    return ImportedMaterial{color_of(given, material, aiTextureType_BASE_COLOR), surface_of(material),
                            images_of(material)};
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, given) != AI_SUCCESS) return {};
  return ImportedMaterial{color_of(given, material, aiTextureType_DIFFUSE), surface_of(material), images_of(material)};
}

// Roughness and metal are in one image in glTF only.
std::vector<MaterialImage> MaterialReader::images_of(const aiMaterial& material) {
  std::vector<MaterialImage> images;
  const auto add = [&](std::string_view use, aiTextureType type) {
    aiString texture;
    const bool is_new = images.empty() || images.back().use != use;
    if (!is_new || material.GetTexture(type, 0, &texture) != AI_SUCCESS) return;
    if (auto file = images_.keep(texture.C_Str())) images.push_back({use, std::move(*file)});
  };
  add("color", aiTextureType_BASE_COLOR);
  add("color", aiTextureType_DIFFUSE);
  add("normal", aiTextureType_NORMALS);
  if (is_gltf(kind_)) add("surface", aiTextureType_METALNESS);
  add("glow", aiTextureType_EMISSIVE);
  return images;
}

const images::PictureMean* MaterialReader::mean_of(const aiMaterial& material, aiTextureType type,
                                                   std::set<std::string>& used) {
  aiString path;
  if (material.GetTexture(type, 0, &path) != AI_SUCCESS) return nullptr;
  const std::optional<images::PictureMean>& mean = means_.mean_of(path.C_Str());
  if (!mean) return nullptr;
  used.insert(path.C_Str());
  return &*mean;
}

std::array<double, 3> MaterialReader::color_of(const aiColor4D& given, const aiMaterial& material,
                                               aiTextureType texture) {
  std::array<double, 3> color{given.r, given.g, given.b};
  cut_colors_ += std::ranges::any_of(color, [](double c) { return !(c >= 0 && c <= 1); });
  const images::PictureMean* mean = mean_of(material, texture, colors_);
  for (std::size_t i = 0; i < 3; ++i) {
    const double factor = within_one(color[i]);
    double light = is_gltf(kind_) ? factor : document::light_of_shown(factor);
    if (mean != nullptr) light *= mean->light[i];
    color[i] = rounded(document::shown_of_light(light));
  }
  return color;
}

// In the texture, green is roughness and blue metal.
std::optional<Surface> MaterialReader::surface_of(const aiMaterial& material) {
  if (const auto gloss = importer::number_of(material, AI_MATKEY_GLOSSINESS_FACTOR); is_gltf(kind_) && gloss)
    return Surface{rounded(1 - within_one(*gloss)), 0};
  const auto roughness = importer::number_of(material, AI_MATKEY_ROUGHNESS_FACTOR),
             metallic = importer::number_of(material, AI_MATKEY_METALLIC_FACTOR);
  if (!roughness && !metallic) return {};
  Surface surface{within_one(roughness.value_or(0.5f)), within_one(metallic.value_or(0))};
  if (is_gltf(kind_))
    if (const images::PictureMean* mean = mean_of(material, aiTextureType_METALNESS, surfaces_)) {
      surface.roughness *= mean->values[1];
      surface.metallic *= mean->values[2];
    }
  return Surface{rounded(surface.roughness), rounded(surface.metallic)};
}

}  // namespace mars::importer
