#include "host/content/importer/scene_sources.h"

#include <assimp/MemoryIOWrapper.h>

#include <cstdint>

#include "hal/failure/failure.h"
#include "host/content/importer/sources/companion.h"

namespace mars::importer {

namespace fs = std::filesystem;

bool SceneSources::Exists(const char* name) const { return called_ == name || DefaultIOSystem::Exists(name); }

Assimp::IOStream* SceneSources::Open(const char* called, const char* mode) {
  if (called_ == called && !unpacked_.empty())
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(unpacked_.data()), unpacked_.size());
  const char* name = called_ == called ? mesh_.c_str() : called;
  const fs::path from_folder = fs::path(name).lexically_relative(folder_);  // "" where no path leads there
  if (mesh_ != name) companion(mesh_, from_folder.empty() ? name : from_folder.string());
  std::error_code none;
  const fs::file_status status = fs::status(name, none);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw Failure(fs::is_directory(status) ? "is a directory, not a file" : "is not a regular file", name,
                  mesh_.string() + " names it: let it name a file on a disk");
  Assimp::IOStream* stream = DefaultIOSystem::Open(name, mode);
  if (stream == nullptr)
    not_opened_.emplace_back(name);
  else if (mesh_ != name)
    companions_.emplace_back(name);
  return stream;
}

}  // namespace mars::importer
