#include "host/content/importer/scene_textures.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "host/content/document/text.h"
#include "host/content/importer/gltf/gltf_json.h"
#include "host/content/importer/sources/companion.h"

namespace mars::importer {

std::optional<SceneTexture> SceneTextures::find(const std::string& texture) const {
  const auto [picture, number] = scene_.GetEmbeddedTextureAndIndex(texture.c_str());
  if (picture != nullptr && picture->mHeight == 0)
    return SceneTexture{"picture " + std::to_string(number + 1),
                        {reinterpret_cast<const char*>(picture->pcData), picture->mWidth},
                        {},
                        picture->mFilename.C_Str()};
  if (texture.starts_with('*')) return std::nullopt;
  const auto path = file_of(texture);
  if (!path) return std::nullopt;
  return SceneTexture{document::printable(texture), {}, *path, path->filename().string()};
}

// FBX and COLLADA name files as they were where they were written, such as "C:\\work\\skin.png"; these may lie beside
// the mesh now.
std::optional<std::filesystem::path> SceneTextures::file_of(const std::string& texture) const {
  std::string name = is_gltf(kind_) ? percent_decoded(texture) : texture;
  std::vector<std::filesystem::path> names{name};
  if (has_nodes(kind_) && !is_gltf(kind_)) {
    std::ranges::replace(name, '\\', '/');
    names = {name, std::filesystem::path(name).filename()};
  }
  for (const std::filesystem::path& each : names) {
    std::error_code none;
    const std::filesystem::path path = mesh_.parent_path() / each;
    if (stays_inside(each) && std::filesystem::is_regular_file(path, none)) return companion(mesh_, each.string());
  }
  return std::nullopt;
}

}  // namespace mars::importer
