// Where the pictures are that a scene's materials name: within its file, or in files beside it.
#pragma once

#include <assimp/scene.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "host/content/importer/file_kind.h"

namespace mars::importer {

inline constexpr std::uintmax_t kLargestPicture = std::uintmax_t{1} << 28;

struct SceneTexture {
  std::string name;            // "picture 2", "skin.png": for people
  std::string_view bytes;      // of a picture within the file, as long as the scene
  std::filesystem::path from;  // where it is not within: the file beside it, which is there
  std::string file_name;       // as the file calls it; "": it does not
};

class SceneTextures {
 public:
  SceneTextures(std::filesystem::path mesh, FileKind kind, const aiScene& scene)
      : mesh_(std::move(mesh)), kind_(kind), scene_(scene) {}
  SceneTextures(auto&&, auto&&, const aiScene&&) = delete;

  // The picture that a material names `texture`: "*2" is a picture within the file, else it is a file's path. None
  // where it is not there, or no picture's file but colours of pixels.
  std::optional<SceneTexture> find(const std::string& texture) const;

 private:
  std::optional<std::filesystem::path> file_of(const std::string& texture) const;

  std::filesystem::path mesh_;
  FileKind kind_;
  const aiScene& scene_;
};

}  // namespace mars::importer
