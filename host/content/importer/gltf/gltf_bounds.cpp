#include "host/content/importer/gltf/gltf_bounds.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "hal/failure/failure.h"

namespace mars::importer {
namespace {

// Their products and sums do not wrap.
constexpr std::size_t kMost = std::size_t{1} << 31;

// glTF 2.0, 3.6.2.2 and 3.6.2.3: components of an element, bytes of a component; 0 of what is unknown.
std::size_t components_of(const Tree& type) {
  static const std::map<std::string_view, std::size_t> kComponents = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  const auto found = kComponents.find(type.is_string() ? type.get_ref<const std::string&>() : "");
  return found == kComponents.end() ? 0 : found->second;
}

std::size_t bytes_of(std::size_t component_type) {
  constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4, 4};  // from 5120: byte, ..., int (not allowed), ..., float
  return component_type >= 5120 && component_type <= 5126 ? kBytes[component_type - 5120] : 0;
}

bool is_within(const Tree& part, std::size_t length, const Tree& whole) {
  const std::size_t begin = number(at(part, "byteOffset"), 0), end = number(at(whole, "byteLength"), 0);
  return begin <= kMost && length <= kMost && begin + length <= end;
}

// Views and accessors of nothing are Assimp's to refuse.
bool is_accessor_sound(const Tree& accessor, const Tree& views) {
  const Tree& view = item(views, at(accessor, "bufferView"));
  const std::size_t element = components_of(at(accessor, "type")) * bytes_of(number(at(accessor, "componentType"), 0));
  const std::size_t count = number(at(accessor, "count"), 0);
  if (view.is_null() || element == 0 || count == 0) return true;
  const std::size_t stride = number(at(view, "byteStride"), element);
  return stride <= kMost && count <= kMost && is_within(accessor, stride * (count - 1) + element, view);
}

// Where some numbers of an accessor are given by their places.
bool is_sparse_sound(const Tree& accessor, const Tree& views) {
  const Tree& sparse = at(accessor, "sparse");
  if (sparse.is_null()) return true;
  const std::size_t element = components_of(at(accessor, "type")) * bytes_of(number(at(accessor, "componentType"), 0));
  const std::size_t count = number(at(sparse, "count"), 0);
  const auto fits = [&](const char* key, std::size_t bytes) {
    const Tree& part = at(sparse, key);
    const Tree& view = item(views, at(part, "bufferView"));
    return !view.is_null() && bytes > 0 && count <= kMost && is_within(part, count * bytes, view);
  };
  const std::size_t type = number(at(at(sparse, "indices"), "componentType"), 0);
  const bool is_whole = type == 5121 || type == 5123 || type == 5125;
  return is_whole && number(at(accessor, "count"), 0) <= kMost && fits("indices", bytes_of(type)) &&
         fits("values", element);
}

struct Attribute {
  std::string_view name;  // without its set's number
  std::string_view type, other_type;
};

// glTF 2.0, 3.7.2.1; of targets tangents have three numbers.
constexpr Attribute kAttributes[] = {{"POSITION", "VEC3", "VEC3"}, {"NORMAL", "VEC3", "VEC3"},
                                     {"TANGENT", "VEC4", "VEC3"},  {"TEXCOORD_", "VEC2", "VEC2"},
                                     {"COLOR_", "VEC3", "VEC4"},   {"JOINTS_", "VEC4", "VEC4"},
                                     {"WEIGHTS_", "VEC4", "VEC4"}};

bool are_alike(const Tree& attributes, const Tree& accessors, std::size_t vertices) {
  if (!attributes.is_object()) return true;
  for (const auto& [name, index] : attributes.items()) {
    const Tree& accessor = item(accessors, index);
    const auto is_it = [&](const Attribute& each) { return name.starts_with(each.name); };
    const auto known = std::ranges::find_if(kAttributes, is_it);
    if (accessor.is_null() || known == std::end(kAttributes)) continue;
    const Tree& type = at(accessor, "type");
    if (number(at(accessor, "count"), 0) != vertices) return false;
    if (type != known->type && type != known->other_type) return false;
  }
  return !attributes.contains("WEIGHTS_1") || attributes.contains("WEIGHTS_0");
}

}  // namespace

void require_alike_attributes(const std::filesystem::path& path, const Tree& gltf) {
  const Tree& accessors = at(gltf, "accessors");
  for (const Tree& mesh : at(gltf, "meshes"))
    for (const Tree& primitive : at(mesh, "primitives")) {
      const Tree& attributes = at(primitive, "attributes");
      const std::size_t vertices = number(at(item(accessors, at(attributes, "POSITION")), "count"), 0);
      bool sound = are_alike(attributes, accessors, vertices);
      for (const Tree& target : at(primitive, "targets")) sound = sound && are_alike(target, accessors, vertices);
      if (!sound)
        throw Failure("has a mesh whose places, normals, weights or the like do not fit each other", path.string(),
                      "export it again");
    }
}

void require_within_buffers(const std::filesystem::path& path, const Tree& gltf) {
  const Tree &views = at(gltf, "bufferViews"), &buffers = at(gltf, "buffers");
  bool sound = true;
  for (const Tree& view : views) {
    const Tree& buffer = item(buffers, at(view, "buffer"));
    sound = sound && (buffer.is_null() || is_within(view, number(at(view, "byteLength"), 0), buffer));
  }
  for (const Tree& accessor : at(gltf, "accessors"))
    sound = sound && is_accessor_sound(accessor, views) && is_sparse_sound(accessor, views);
  if (!sound) throw Failure("has numbers beyond the end of their buffer", path.string(), "export it again");
}

}  // namespace mars::importer
