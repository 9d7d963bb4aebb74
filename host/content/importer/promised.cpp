#include "host/content/importer/promised.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"

namespace mars::importer {
namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 30;
constexpr std::string_view kSpace = " \t\r\n\f\v";

// The next line of `text`, which loses it; one that ends in "\" goes on in the next.
std::string_view take_line(std::string_view& text) {
  const auto goes_on = [&](std::size_t end) {
    return text.substr(0, end).ends_with("\\") || text.substr(0, end).ends_with("\\\r");
  };
  std::size_t end = text.find('\n');
  while (end != std::string_view::npos && goes_on(end)) end = text.find('\n', end + 1);
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kSpace));
  line.remove_prefix(word.size());
  return word;
}

std::size_t words_in(std::string_view line) {
  std::size_t count = 0;
  while (!take_word(line).empty()) ++count;
  return count;
}

Promised promised_by_obj(const std::filesystem::path& path, std::string_view text) {
  Promised promised{0, 0, {}};
  std::size_t surfaces = 0;
  while (!text.empty()) {
    std::string_view line = take_line(text);
    const std::string_view word = take_word(line);
    if (word == "f") *promised.faces += words_in(line) >= 3;
    *promised.vertices += word == "v";
    surfaces += word == "surf" || word == "curv" || word == "curv2";
    if (word != "mtllib") continue;
    line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
    const std::string name(line.substr(0, line.find_last_not_of(kSpace) + 1));
    std::error_code none;
    if (!std::filesystem::exists(path.parent_path() / name, none))
      promised.not_read.push_back("colours of " + document::printable(name) + " (no such file beside the mesh)");
  }
  if (surfaces > 0)
    promised.not_read.push_back(
        document::counted(surfaces, "free-form curve or surface", "free-form curves or surfaces"));
  return promised;
}

std::uint32_t little_endian_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

Promised promised_by_stl(std::string_view bytes) {
  constexpr std::size_t kHeader = 84, kFacet = 50;
  if (bytes.size() >= kHeader) {
    const std::size_t facets = little_endian_at(bytes, kHeader - 4);
    if (bytes.size() == kHeader + kFacet * facets) return {facets, {}, {}};
  }
  Promised promised{0, {}, {}};
  while (!bytes.empty()) {
    std::string_view line = take_line(bytes);
    *promised.faces += take_word(line) == "facet";
  }
  return promised;
}

using Tree = nlohmann::json;

// What `tree` has under `key`; null where it is no object or has none.
const Tree& at(const Tree& tree, const char* key) {
  static const Tree null;
  const auto found = tree.find(key);
  return found == tree.end() ? null : *found;
}

std::size_t number(const Tree& tree, std::size_t otherwise) {
  return tree.is_number_unsigned() ? tree.get<std::size_t>() : otherwise;
}

// Item `index` of a list; null where there is none.
const Tree& item(const Tree& list, const Tree& index) {
  static const Tree null;
  const std::size_t place = number(index, list.size());
  return list.is_array() && place < list.size() ? list[place] : null;
}

// Without the shapes of these, the file cannot be read; other extensions are about what models do not have.
void refuse_extensions(const std::filesystem::path& path, const Tree& required) {
  for (const char* extension : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization"})
    if (std::find(required.begin(), required.end(), extension) != required.end())
      throw Failure(std::string("has its shapes packed as ") + extension, path.string(),
                    "export it without compression and quantization");
}

std::size_t triangles_of(const Tree& primitive, const Tree& accessors) {
  const Tree& indices = at(primitive, "indices");
  const Tree& accessor = item(accessors, indices.is_null() ? at(at(primitive, "attributes"), "POSITION") : indices);
  const std::size_t corners = number(at(accessor, "count"), 0);
  const std::size_t mode = number(at(primitive, "mode"), 4);
  if (mode == 4) return corners / 3;                                 // triangles
  return (mode == 5 || mode == 6) && corners > 2 ? corners - 2 : 0;  // a strip, a fan
}

// The numbers of the meshes that the nodes of the file's scene name: the others are not read.
std::set<std::size_t> meshes_in_scene(const Tree& tree) {
  std::set<std::size_t> meshes, visited;
  std::vector<Tree> nodes;
  const Tree& scene = at(tree, "scene");
  for (const Tree& node : at(item(at(tree, "scenes"), scene.is_null() ? Tree(0u) : scene), "nodes"))
    nodes.push_back(node);
  while (!nodes.empty()) {
    const Tree index = std::move(nodes.back());
    nodes.pop_back();
    const Tree& node = item(at(tree, "nodes"), index);
    if (node.is_null() || !visited.insert(number(index, 0)).second) continue;
    if (const Tree& mesh = at(node, "mesh"); !item(at(tree, "meshes"), mesh).is_null()) meshes.insert(number(mesh, 0));
    for (const Tree& child : at(node, "children")) nodes.push_back(child);
  }
  return meshes;
}

// The JSON of a GLB: after its header of 12 bytes, a chunk of its length, "JSON" and itself.
std::string_view json_of(std::string_view bytes, FileKind kind) {
  if (kind == FileKind::gltf) return bytes;
  return bytes.size() < 20 ? "" : bytes.substr(20, little_endian_at(bytes, 12));
}

Promised promised_by_gltf(const std::filesystem::path& path, std::string_view bytes, FileKind kind) {
  const std::string_view json = json_of(bytes, kind);
  const Tree tree = Tree::parse(json, nullptr, false);
  if (tree.is_discarded()) return {};
  refuse_extensions(path, at(tree, "extensionsRequired"));
  Promised promised{0, {}, {}};
  const Tree& meshes = at(tree, "meshes");
  const std::set<std::size_t> placed = meshes_in_scene(tree);
  for (const std::size_t mesh : placed)
    for (const Tree& primitive : at(meshes[mesh], "primitives"))
      *promised.faces += triangles_of(primitive, at(tree, "accessors"));
  if (placed.size() < meshes.size())
    promised.not_read.push_back(document::counted(meshes.size() - placed.size(), "mesh", "meshes") +
                                " outside the scene");
  return promised;
}

}  // namespace

Promised promised_by(const std::filesystem::path& path, FileKind kind) {
  const std::string bytes = document::read_file(path, kLargestFile);
  if (kind == FileKind::obj) return promised_by_obj(path, bytes);
  if (kind == FileKind::stl) return promised_by_stl(bytes);
  return promised_by_gltf(path, bytes, kind);
}

namespace {

// "my%20mesh.bin" is the file "my mesh.bin".
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

}  // namespace

std::uintmax_t bytes_of_buffers(const std::filesystem::path& path) {
  const Tree tree = Tree::parse(document::read_file(path, kLargestFile), nullptr, false);
  std::uintmax_t sum = 0;
  for (const Tree& buffer : at(tree, "buffers")) {
    const Tree& uri = at(buffer, "uri");
    if (!uri.is_string() || uri.get_ref<const std::string&>().starts_with("data:")) continue;
    std::error_code error;
    const std::uintmax_t size =
        std::filesystem::file_size(path.parent_path() / percent_decoded(uri.get_ref<const std::string&>()), error);
    if (!error) sum += size;
  }
  return sum;
}

}  // namespace mars::importer
