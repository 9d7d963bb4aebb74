// What a mesh file itself says that it holds, found without Assimp, which leaves out without a word what it cannot
// read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/content/importer/file_kind.h"
#include "host/content/importer/gltf/gltf_json.h"

namespace mars::importer {

struct Promised {
  std::optional<std::size_t> faces;     // none: what it says is not understood, and Assimp's refusal says why
  std::optional<std::size_t> vertices;  // OBJ's, which Assimp gives once for each corner of a face
  std::vector<std::string> not_read;    // of what Assimp passes over
};

// Of OBJ, STL, glTF and GLB with these bytes, `gltf` the JSON of the last two. glTF's meshes count once each, however
// often they stand in its scene. Refuses glTF that requires an extension without which its shapes cannot be read.
Promised promised_by(const std::filesystem::path& path, FileKind kind, std::string_view bytes, const Tree& gltf);

}  // namespace mars::importer
