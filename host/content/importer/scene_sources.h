// The files that Assimp reads: a mesh file and those that it names, such as materials and buffers.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <vector>

namespace mars::importer {

class SceneSources : public Assimp::DefaultIOSystem {
 public:
  // `called`: as Assimp knows the mesh file, whose endings do not include .vrm.
  SceneSources(std::filesystem::path mesh, std::filesystem::path called)
      : mesh_(std::move(mesh)),
        called_(std::move(called)),
        folder_(mesh_.has_parent_path() ? mesh_.parent_path() : ".") {}

  // Throws Failure where what is called so is outside of the mesh's folder, or is there and no regular file: a pipe
  // would wait, a device never end.
  Assimp::IOStream* Open(const char* called, const char* mode) override;
  bool Exists(const char* name) const override { return DefaultIOSystem::Exists(file_of(name)); }

  // What Open() has opened besides the mesh file, and what it could not open: both in the order of its calls.
  const std::vector<std::filesystem::path>& companions() const { return companions_; }
  const std::vector<std::filesystem::path>& not_opened() const { return not_opened_; }

 private:
  const char* file_of(const char* name) const { return called_ == name ? mesh_.c_str() : name; }

  std::filesystem::path mesh_, called_, folder_;
  std::vector<std::filesystem::path> companions_, not_opened_;
};

}  // namespace mars::importer
