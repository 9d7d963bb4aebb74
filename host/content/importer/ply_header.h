// The header of a PLY file: what numbers follow it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mars::importer {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count;  // of a list: its length's
};

struct PlyElement {
  std::string name;
  std::uint64_t count;
  std::vector<PlyProperty> properties;
};

enum class PlyFormat { text, little_endian, big_endian };

struct PlyHeader {
  PlyFormat format = PlyFormat::text;
  std::vector<PlyElement> elements;
  std::vector<std::string> textures;  // that its comments name
  std::size_t bytes = 0;              // of the header itself
};

// From the text of the file `path`. No two elements have one name, no two properties of one either.
PlyHeader read_ply_header(const std::filesystem::path& path, std::string_view text);

[[noreturn]] void fail_ply(const std::filesystem::path& path, const std::string& problem);

}  // namespace mars::importer
