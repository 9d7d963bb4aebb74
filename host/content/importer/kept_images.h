// The images that a scene's materials show, as files of their own beside the model: so the model needs nothing of the
// files that it was made of, which may have been a download. Their bytes stay as they are.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/content/importer/imported_mesh.h"
#include "host/content/importer/scene_textures.h"

namespace mars::importer {

class KeptImages {
 public:
  // `folder`: "rock-images", in which they will lie. `textures` outlives it.
  KeptImages(std::string folder, const SceneTextures& textures) : folder_(std::move(folder)), textures_(textures) {}
  KeptImages(auto&&, const SceneTextures&&) = delete;

  // The file that the image of `texture` becomes: "rock-images/stone.png". None unless it is a PNG or JPEG file that
  // can be found.
  std::optional<std::string> keep(const std::string& texture);

  bool has(const std::string& texture) const;
  std::vector<KeptImage>& images() { return images_; }

 private:
  std::optional<std::string> read(const std::string& texture);
  std::string unused_name(const std::string& wanted, const std::string& ending);

  std::string folder_;
  const SceneTextures& textures_;
  std::map<std::string, std::optional<std::string>> files_;  // by texture
  std::set<std::string> names_;
  std::vector<KeptImage> images_;
};

}  // namespace mars::importer
