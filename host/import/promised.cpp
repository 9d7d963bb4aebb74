#include "host/import/promised.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "hal/failure.h"
#include "host/document/file.h"
#include "host/import/import_report.h"

namespace mars::host {
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
  Promised promised{0, {}};
  std::size_t surfaces = 0;
  while (!text.empty()) {
    std::string_view line = take_line(text);
    const std::string_view word = take_word(line);
    if (word == "f") *promised.faces += words_in(line) >= 3;
    surfaces += word == "surf" || word == "curv" || word == "curv2";
    if (word != "mtllib") continue;
    line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
    const std::string name(line.substr(0, line.find_last_not_of(kSpace) + 1));
    if (!std::filesystem::exists(path.parent_path() / name))
      promised.not_read.push_back("colours of " + printable(name) + " (no such file beside the mesh)");
  }
  if (surfaces > 0) promised.not_read.push_back(counted(surfaces, "free-form curve or surface", "free-form curves or surfaces"));
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
    if (bytes.size() == kHeader + kFacet * facets) return {facets, {}};
  }
  Promised promised{0, {}};
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

// Without the shapes of these, the file cannot be read; other extensions are about what models do not have.
void refuse_extensions(const std::filesystem::path& path, const Tree& required) {
  for (const char* extension : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization"})
    if (std::find(required.begin(), required.end(), extension) != required.end())
      throw Failure(std::string("has its shapes packed as ") + extension, path.string(),
                    "export it without compression and quantization");
}

std::size_t triangles_of(const Tree& primitive, const Tree& accessors) {
  const Tree& indices = at(primitive, "indices");
  const std::size_t accessor = number(indices.is_null() ? at(at(primitive, "attributes"), "POSITION") : indices, accessors.size());
  if (!accessors.is_array() || accessor >= accessors.size()) return 0;
  const std::size_t corners = number(at(accessors[accessor], "count"), 0);
  const std::size_t mode = number(at(primitive, "mode"), 4);
  if (mode == 4) return corners / 3;                                  // triangles
  return (mode == 5 || mode == 6) && corners > 2 ? corners - 2 : 0;  // a strip, a fan
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
  Promised promised{0, {}};
  for (const Tree& mesh : at(tree, "meshes"))
    for (const Tree& primitive : at(mesh, "primitives"))
      *promised.faces += triangles_of(primitive, at(tree, "accessors"));
  return promised;
}

}  // namespace

Promised promised_by(const std::filesystem::path& path, FileKind kind) {
  const std::string bytes = read_file(path, kLargestFile);
  if (kind == FileKind::obj) return promised_by_obj(path, bytes);
  if (kind == FileKind::stl) return promised_by_stl(bytes);
  return promised_by_gltf(path, bytes, kind);
}

}  // namespace mars::host
