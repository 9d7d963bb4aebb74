#include "host/content/importer/promised.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/importer/sources/companion.h"

namespace mars::importer {
namespace {

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
    if (!name.empty() && !std::filesystem::exists(companion(path, name), none))
      promised.not_read.push_back("colours of " + document::printable(name) + " (no such file beside the mesh)");
  }
  if (surfaces > 0)
    promised.not_read.push_back(
        document::counted(surfaces, "free-form curve or surface", "free-form curves or surfaces"));
  return promised;
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

// This extension packs shapes, without which the file cannot be read; other extensions are unpacked before, or about
// what models do not have.
void refuse_extensions(const std::filesystem::path& path, const Tree& required) {
  constexpr const char* kPacked = "KHR_meshopt_compression";
  if (std::find(required.begin(), required.end(), kPacked) != required.end())
    throw Failure(std::string("has its shapes packed as ") + kPacked, path.string(),
                  "export it with EXT_meshopt_compression or Draco's compression, or unpack it: gltfpack -noq "
                  "-i in.glb -o out.glb");
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
  const Tree& all = at(tree, "nodes");
  std::vector<std::size_t> nodes = root_nodes(tree);
  while (!nodes.empty()) {
    const std::size_t index = nodes.back();
    nodes.pop_back();
    if (!visited.insert(index).second) continue;
    const Tree& node = all[index];
    if (const Tree& mesh = at(node, "mesh"); !item(at(tree, "meshes"), mesh).is_null()) meshes.insert(number(mesh, 0));
    for (const std::size_t child : places_in(all, at(node, "children"))) nodes.push_back(child);
  }
  return meshes;
}

Promised promised_by_gltf(const std::filesystem::path& path, const Tree& tree) {
  if (tree.is_null()) return {};
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

Promised promised_by(const std::filesystem::path& path, FileKind kind, std::string_view bytes, const Tree& gltf) {
  if (kind == FileKind::obj) return promised_by_obj(path, bytes);
  if (kind == FileKind::stl) return promised_by_stl(bytes);
  if (!is_gltf(kind)) return {};
  return promised_by_gltf(path, gltf);
}

}  // namespace mars::importer
