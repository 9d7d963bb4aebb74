#include "host/content/importer/gltf/gltf_json.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "host/content/document/file.h"
#include "host/content/importer/sources/companion.h"

namespace mars::importer {
namespace {

const Tree kNull;
constexpr std::uintmax_t kMostPacked = 16;  // how many times as many bytes packed ones may stand for, for limits

// As the file says; bytes_of_buffers() sets a limit.
std::uintmax_t bytes_of_packed_views(const Tree& gltf) {
  std::uintmax_t sum = 0;
  for (const Tree& view : at(gltf, "bufferViews"))
    if (!at(at(view, "extensions"), "EXT_meshopt_compression").is_null())
      sum += std::min<std::size_t>(number(at(view, "byteLength"), 0), kLargestMeshFile);
  return sum;
}

}  // namespace

std::uint32_t little_endian_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

bool is_binary(std::string_view bytes) { return bytes.starts_with("glTF"); }

// A GLB has, after its header of 12 bytes, a chunk of its length, "JSON" and itself.
Tree gltf_json(std::string_view bytes) {
  if (is_binary(bytes)) bytes = bytes.size() < 20 ? "" : bytes.substr(20, little_endian_at(bytes, 12));
  Tree tree = Tree::parse(bytes, nullptr, false);
  return tree.is_discarded() ? Tree() : tree;
}

const Tree& at(const Tree& tree, const char* key) {
  const auto found = tree.find(key);
  return found == tree.end() ? kNull : *found;
}

const Tree& item(const Tree& list, const Tree& index) {
  const std::size_t place = number(index, list.size());
  return list.is_array() && place < list.size() ? list[place] : kNull;
}

std::size_t number(const Tree& tree, std::size_t otherwise) {
  return tree.is_number_unsigned() ? tree.get<std::size_t>() : otherwise;
}

std::vector<std::size_t> places_in(const Tree& list, const Tree& numbers) {
  std::vector<std::size_t> places;
  if (!list.is_array() || !numbers.is_array()) return places;
  for (const Tree& each : numbers)
    if (const std::size_t place = number(each, list.size()); place < list.size()) places.push_back(place);
  return places;
}

std::vector<std::size_t> root_nodes(const Tree& gltf) {
  const Tree& scene = at(gltf, "scene");
  return places_in(at(gltf, "nodes"), at(item(at(gltf, "scenes"), scene.is_null() ? Tree(0u) : scene), "nodes"));
}

std::string percent_decoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned byte = 0;
    const char* digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      text += static_cast<char>(byte);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

std::uintmax_t bytes_of_buffers(const std::filesystem::path& path) {
  const std::string bytes = document::read_file(path, kLargestMeshFile);
  const Tree tree = gltf_json(bytes);
  std::uintmax_t sum = 0;
  for (const Tree& buffer : at(tree, "buffers")) {
    const Tree& uri = at(buffer, "uri");
    if (!uri.is_string() || uri.get_ref<const std::string&>().starts_with("data:")) continue;
    std::error_code error;
    const std::uintmax_t size =
        std::filesystem::file_size(companion(path, percent_decoded(uri.get_ref<const std::string&>())), error);
    if (!error) sum += size;
  }
  return sum + std::min<std::uintmax_t>(bytes_of_packed_views(tree), kMostPacked * (bytes.size() + sum));
}

}  // namespace mars::importer
