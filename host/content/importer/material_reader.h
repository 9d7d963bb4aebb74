// What a scene's materials become. glTF's are metallic and rough, its base colour is light; OBJ's colours are as shown,
// and some files give roughness and metal too. Where a texture has the colour, its mean stands for it, and the
// image is kept.
#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/content/importer/file_kind.h"
#include "host/content/importer/imported_mesh.h"
#include "host/content/importer/kept_images.h"
#include "host/content/importer/scene_textures.h"
#include "host/content/importer/texture_means.h"

namespace mars::importer {

class MaterialReader {
 public:
  // `images_folder` as in MeshOptions.
  MaterialReader(const std::filesystem::path& path, FileKind kind, const aiScene& scene,
                 const std::string& images_folder)
      : kind_(kind),
        scene_(scene),
        textures_(path, kind, scene),
        means_(textures_),
        images_(images_folder, textures_) {}
  MaterialReader(auto&&, auto&&, const aiScene&&, auto&&...) = delete;

  // The number, among materials(), of what the mesh's material becomes; none where the file gives it none. Materials
  // that become the same are one.
  std::optional<std::size_t> number_of(const aiMesh& mesh);

  const std::vector<ImportedMaterial>& materials() const { return materials_; }
  const TextureMeans& means() const { return means_; }
  KeptImages& images() { return images_; }
  const KeptImages& images() const { return images_; }
  std::size_t textures_of_colors() const { return colors_.size(); }
  std::size_t textures_of_surfaces() const { return surfaces_.size(); }
  std::size_t cut_colors() const { return cut_colors_; }

 private:
  bool is_given(const aiMesh& mesh) const;
  std::optional<ImportedMaterial> read(const aiMaterial& material);
  std::array<double, 3> color_of(const aiColor4D& given, const aiMaterial& material, aiTextureType texture);
  std::optional<Surface> surface_of(const aiMaterial& material);
  std::vector<MaterialImage> images_of(const aiMaterial& material);
  const images::PictureMean* mean_of(const aiMaterial& material, aiTextureType type, std::set<std::string>& used);

  FileKind kind_;
  const aiScene& scene_;
  SceneTextures textures_;
  TextureMeans means_;
  KeptImages images_;
  std::vector<ImportedMaterial> materials_;
  std::map<unsigned, std::optional<std::size_t>> numbers_;  // by the scene's
  std::set<std::string> colors_, surfaces_;                 // textures whose means stand in materials
  std::size_t cut_colors_ = 0;
};

}  // namespace mars::importer
