// The means of the pictures that a scene's materials have as textures. Each is read in a process of its own, as meshes
// are: a damaged picture costs the model its colour, no more.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/content/importer/scene_textures.h"
#include "host/images/picture_mean.h"

namespace mars::importer {

class TextureMeans {
 public:
  // `textures` outlives it.
  explicit TextureMeans(const SceneTextures& textures) : textures_(textures) {}
  explicit TextureMeans(const SceneTextures&&) = delete;

  // Of the picture that a material names `texture`. None where it cannot be read, which not_read() then lists.
  const std::optional<images::PictureMean>& mean_of(const std::string& texture);

  bool has(const std::string& texture) const;

  const std::vector<std::string>& not_read() const { return not_read_; }
  const std::vector<std::filesystem::path>& companions() const { return companions_; }

 private:
  std::optional<images::PictureMean> read(const std::string& texture);
  std::optional<images::PictureMean> mean_of_bytes(std::string_view bytes, const std::string& name);

  const SceneTextures& textures_;
  std::map<std::string, std::optional<images::PictureMean>> means_;
  std::vector<std::string> not_read_;
  std::vector<std::filesystem::path> companions_;
};

}  // namespace mars::importer
