// The JSON of glTF and GLB files, read leniently: what is missing or of another kind is null, for Assimp refuses what
// is not as glTF should be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace mars::importer {

using Tree = nlohmann::json;

inline constexpr std::size_t kFloatType = 5126;  // of components of numbers (glTF 2.0, 3.6.2.2)
inline constexpr std::uintmax_t kLargestMeshFile = std::uintmax_t{1} << 30;

// Whether the file is a GLB, by how its bytes begin.
bool is_binary(std::string_view bytes);

// Of a .gltf's or .glb's bytes; null where it is no JSON.
Tree gltf_json(std::string_view bytes);

// What `tree` has under `key`; null where it is no object or has none.
const Tree& at(const Tree& tree, const char* key);
const Tree& at(const Tree&&, const char*) = delete;

// Item `index` of a list; null where there is none.
const Tree& item(const Tree& list, const Tree& index);
const Tree& item(const Tree&&, auto&&) = delete;

std::size_t number(const Tree& tree, std::size_t otherwise);

// The items of `numbers` that are places in `list`.
std::vector<std::size_t> places_in(const Tree& list, const Tree& numbers);

// The numbers of the nodes that stand in the file's scene, each on no other.
std::vector<std::size_t> root_nodes(const Tree& gltf);

// The number in `bytes` at `at`, the lowest byte first.
std::uint32_t little_endian_at(std::string_view bytes, std::size_t at);

// "my%20mesh.bin" is the file "my mesh.bin".
std::string percent_decoded(const std::string& uri);

// The size of the files that a glTF file's buffers name, which are read with it, and of what EXT_meshopt_compression
// packs, within reason. Refuses buffers outside of its folder.
std::uintmax_t bytes_of_buffers(const std::filesystem::path& path);

}  // namespace mars::importer
