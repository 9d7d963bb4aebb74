// The means of the pictures that a scene's materials have as textures. Each is read in a process of its own, as meshes
// are: a damaged picture costs the model its colour, no more.
#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/content/importer/file_kind.h"
#include "host/images/picture_mean.h"

namespace mars::importer {

class TextureMeans {
 public:
  TextureMeans(std::filesystem::path mesh, FileKind kind, const aiScene& scene)
      : mesh_(std::move(mesh)), kind_(kind), scene_(scene) {}

  // Of the picture that a material names `texture`: "*2" is a picture within the file, else it is a file's path. None
  // where it cannot be read, which not_read() then lists.
  const std::optional<images::PictureMean>& mean_of(const std::string& texture);

  bool has(const std::string& texture) const;

  const std::vector<std::string>& not_read() const { return not_read_; }
  const std::vector<std::filesystem::path>& companions() const { return companions_; }

 private:
  std::optional<images::PictureMean> read(const std::string& texture);
  std::optional<std::filesystem::path> file_of(const std::string& texture) const;
  std::optional<images::PictureMean> mean_of_bytes(std::string_view bytes, const std::string& name);

  std::filesystem::path mesh_;
  FileKind kind_;
  const aiScene& scene_;
  std::map<std::string, std::optional<images::PictureMean>> means_;
  std::vector<std::string> not_read_;
  std::vector<std::filesystem::path> companions_;
};

}  // namespace mars::importer
