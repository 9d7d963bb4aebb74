// The files that Assimp reads: a mesh file and those that it names, such as materials and buffers.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mars::importer {

class SceneSources : public Assimp::DefaultIOSystem {
 public:
  // `called`: as Assimp knows the mesh file, which reads what its ending says. `unpacked`: a GLB that stands there
  // instead of the file; "": none does.
  SceneSources(std::filesystem::path mesh, std::filesystem::path called, std::string unpacked)
      : mesh_(std::move(mesh)),
        called_(std::move(called)),
        folder_(mesh_.has_parent_path() ? mesh_.parent_path() : "."),
        unpacked_(std::move(unpacked)) {}

  // Open() throws Failure where what is called so is outside of the mesh's folder, or is there and no regular file: a
  // pipe would wait, a device never end.
  bool Exists(const char* name) const override;
  Assimp::IOStream* Open(const char* called, const char* mode) override;

  // What Open() has opened besides the mesh file, and what it could not open: both in the order of its calls.
  const std::vector<std::filesystem::path>& companions() const { return companions_; }
  const std::vector<std::filesystem::path>& not_opened() const { return not_opened_; }

 private:
  std::filesystem::path mesh_, called_, folder_;
  std::string unpacked_;
  std::vector<std::filesystem::path> companions_, not_opened_;
};

}  // namespace mars::importer
