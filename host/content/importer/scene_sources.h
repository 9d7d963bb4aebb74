// The files that Assimp reads: a mesh file and those that it names, such as materials and buffers.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mars::importer {

class SceneSources : public Assimp::DefaultIOSystem {
 public:
  // `unpacked`: a GLB, which stands under the name unpacked_name(mesh) instead of it; "": none does.
  SceneSources(std::filesystem::path mesh, std::string unpacked)
      : mesh_(std::move(mesh)),
        folder_(mesh_.has_parent_path() ? mesh_.parent_path() : "."),
        unpacked_(std::move(unpacked)) {}

  static std::string unpacked_name(const std::filesystem::path& mesh) { return mesh.string() + ".unpacked.glb"; }

  // Open() throws Failure where `name` is outside of the mesh's folder, or is there and no regular file: a pipe would
  // wait, a device never end.
  bool Exists(const char* name) const override;
  Assimp::IOStream* Open(const char* name, const char* mode) override;

  // What Open() has opened besides the mesh file, and what it could not open: both in the order of its calls.
  const std::vector<std::filesystem::path>& companions() const { return companions_; }
  const std::vector<std::filesystem::path>& not_opened() const { return not_opened_; }

 private:
  bool is_unpacked(const char* name) const { return !unpacked_.empty() && name == unpacked_name(mesh_); }

  std::filesystem::path mesh_, folder_;
  std::string unpacked_;
  std::vector<std::filesystem::path> companions_, not_opened_;
};

}  // namespace mars::importer
