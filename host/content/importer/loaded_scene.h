// A file as Assimp reads it.
#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "host/content/importer/scene_sources.h"

namespace mars::importer {

class LoadedScene {
 public:
  // Refuses what Assimp cannot read, in failures that name the file or the one that it names. `unpacked`: a GLB that is
  // read instead of it; "": none is.
  explicit LoadedScene(const std::filesystem::path& path, std::string unpacked = "");

  const aiScene& scene() const { return *scene_; }
  const SceneSources& sources() const { return sources_; }

 private:
  const SceneSources& handed_over(std::unique_ptr<SceneSources> sources);
  void rethrow_ours() const;
  [[noreturn]] void refuse() const;

  std::filesystem::path path_;
  std::string name_;  // of what Assimp reads
  Assimp::Importer importer_;
  const SceneSources& sources_;  // the importer's
  const aiScene* scene_;
};

}  // namespace mars::importer
