// glTF files as Assimp 5.2 can read them: it takes bytes and shorts for floats, and knows no EXT_meshopt_compression.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "host/content/importer/gltf/gltf_json.h"

namespace mars::importer {

// A glTF file's bytes, as they are or unpacked.
struct GltfBytes {
  std::string bytes;
  std::unique_ptr<Tree> gltf;  // their JSON, never null
  bool unpacked = false;       // they are a GLB that is no file
};

// Unpacks views of EXT_meshopt_compression, and makes floats of the bytes and shorts that KHR_mesh_quantization, or
// glTF itself, allows for attributes of meshes, except bones' numbers and colours. Matrices of the file's nodes and
// skins bring quantized places to their size. Throws Failure where the file is damaged.
GltfBytes gltf_bytes(const std::filesystem::path& path, std::string bytes);

}  // namespace mars::importer
