#include "host/content/importer/gltf/unpacked_gltf.h"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/importer/gltf/gltf_bounds.h"
#include "host/content/importer/gltf/gltf_numbers.h"
#include "host/content/importer/gltf/meshopt_view.h"

namespace mars::importer {
namespace {

constexpr std::string_view kMeshopt = "EXT_meshopt_compression", kQuantization = "KHR_mesh_quantization";
constexpr std::size_t kLargestView = std::size_t{1} << 31;
constexpr std::array<std::string_view, 3> kModes{"ATTRIBUTES", "TRIANGLES", "INDICES"};
constexpr std::array<std::string_view, 4> kFilters{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};

const Tree& packed_view(const Tree& view) { return at(at(view, "extensions"), kMeshopt.data()); }

// Assimp reads bones' numbers and colours as they are.
bool is_made_floats(std::string_view attribute) {
  return attribute == "POSITION" || attribute == "NORMAL" || attribute == "TANGENT" ||
         attribute.starts_with("TEXCOORD_") || attribute.starts_with("WEIGHTS_");
}

// The accessors of meshes' attributes that are to be floats, and are not.
std::set<std::size_t> packed_accessors(const Tree& gltf) {
  std::set<std::size_t> packed;
  const Tree& accessors = at(gltf, "accessors");
  const auto add = [&](const Tree& attributes) {
    if (!attributes.is_object()) return;
    for (const auto& [name, index] : attributes.items()) {
      const Tree& accessor = item(accessors, index);
      if (!accessor.is_null() && is_made_floats(name) &&
          number(at(accessor, "componentType"), kFloatType) != kFloatType)
        packed.insert(number(index, 0));
    }
  };
  for (const Tree& mesh : at(gltf, "meshes"))
    for (const Tree& primitive : at(mesh, "primitives")) {
      add(at(primitive, "attributes"));
      for (const Tree& target : at(primitive, "targets")) add(target);
    }
  return packed;
}

void append_number(std::string& bytes, std::uint32_t number) {
  for (int byte = 0; byte < 4; ++byte) bytes += static_cast<char>(number >> 8 * byte);
}

void pad(std::string& bytes, char with) { bytes.resize((bytes.size() + 3) / 4 * 4, with); }

std::string glb_of(const Tree& gltf, const std::string& blob) {
  std::string json = gltf.dump();
  pad(json, ' ');
  std::string bytes = "glTF";
  append_number(bytes, 2);
  append_number(bytes, static_cast<std::uint32_t>(28 + json.size() + blob.size()));
  append_number(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append_number(bytes, static_cast<std::uint32_t>(blob.size()));
  return bytes.append("BIN", 4) + blob;
}

class Unpacker {
 public:
  Unpacker(const std::filesystem::path& path, Tree gltf) : path_(path), gltf_(std::move(gltf)) {}

  // From now on all views are in one buffer, which is the GLB's own.
  void unpack_views(std::string_view bytes) {
    const Tree before = gltf_;
    const GltfBuffers buffers(path_, bytes, before, "a view");
    for (Tree& view : gltf_["bufferViews"]) {
      if (!view.is_object()) fail("has a buffer view that is no object");
      const Tree packed = packed_view(view);
      put(view, packed.is_null() ? std::string(buffers.bytes_at(view)) : unpacked(packed, view, buffers));
      if (!packed.is_null()) view["extensions"].erase(std::string(kMeshopt));
    }
    finish_blob();
  }

  void make_floats(const std::set<std::size_t>& accessors) {
    const std::string bytes = glb_of(gltf_, blob_);
    const Tree before = gltf_;
    const GltfBuffers buffers(path_, bytes, before, "a mesh");
    for (const std::size_t index : accessors) {
      if (at(before["accessors"][index], "bufferView").is_null() && at(before["accessors"][index], "sparse").is_null())
        fail("has numbers that are quantized and packed by Draco, which MARS does not read together");
      const GltfNumbers numbers = buffers.read_quantized(index);
      std::string floats;
      for (const double number : numbers.numbers)
        append_number(floats, std::bit_cast<std::uint32_t>(static_cast<float>(number)));
      Tree& accessor = gltf_["accessors"][index];
      for (const char* key : {"normalized", "byteOffset", "sparse", "min", "max"}) accessor.erase(key);
      accessor["componentType"] = kFloatType;
      accessor["bufferView"] = gltf_["bufferViews"].size();
      put(gltf_["bufferViews"].emplace_back(Tree::object()), floats);
    }
    finish_blob();
  }

  GltfBytes finish() {
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
      if (gltf_.contains(list) && gltf_[list].is_array())
        std::erase_if(gltf_[list].get_ref<Tree::array_t&>(),
                      [](const Tree& name) { return name == kMeshopt || name == kQuantization; });
    std::string bytes = glb_of(gltf_, blob_);
    return {std::move(bytes), std::make_unique<Tree>(std::move(gltf_)), true};
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw Failure(problem, path_.string(), "export it again, or unpack it: gltfpack -noq -i in.glb -o out.glb");
  }

  // The number of `word` among `words`; 0 where the file does not have it.
  std::size_t number_of(const Tree& word, std::span<const std::string_view> words) const {
    if (word.is_null()) return 0;
    const auto known = std::ranges::find(words, word.is_string() ? word.get_ref<const std::string&>() : "");
    if (known == words.end()) fail("is packed as " + std::string(kMeshopt) + " in a way that is not known");
    return static_cast<std::size_t>(known - words.begin());
  }

  // Refuses lengths and strides for which the library is not defined.
  std::string unpacked(const Tree& packed, const Tree& view, const GltfBuffers& buffers) const {
    const MeshoptView how{static_cast<MeshoptMode>(number_of(at(packed, "mode"), kModes)),
                          static_cast<MeshoptFilter>(number_of(at(packed, "filter"), kFilters)),
                          number(at(packed, "count"), 0), number(at(packed, "byteStride"), 0)};
    const bool attributes = how.mode == MeshoptMode::attributes;
    bool sound =
        attributes ? how.stride % 4 == 0 && how.stride > 0 && how.stride <= 256 : how.stride == 2 || how.stride == 4;
    if (how.filter == MeshoptFilter::octahedral) sound = sound && (how.stride == 4 || how.stride == 8);
    if (how.filter == MeshoptFilter::quaternion) sound = sound && how.stride == 8;
    sound = sound && (attributes || how.filter == MeshoptFilter::none) && how.count <= kLargestView / how.stride &&
            (how.mode != MeshoptMode::triangles || how.count % 3 == 0);
    if (!sound || how.count * how.stride != number(at(view, "byteLength"), 0))
      fail("has numbers packed as " + std::string(kMeshopt) + " that do not fit their view");
    std::string bytes = meshopt_unpacked(path_, how, buffers.bytes_at(packed));
    if (bytes.size() != how.count * how.stride) fail("has damaged numbers, packed as " + std::string(kMeshopt));
    return bytes;
  }

  void put(Tree& view, const std::string& bytes) {
    view["buffer"] = 0u;
    view["byteOffset"] = blob_.size();
    view["byteLength"] = bytes.size();
    blob_ += bytes;
    pad(blob_, '\0');
    if (blob_.size() > kLargestView) fail("has more than 2 GiB of numbers");
  }

  void finish_blob() { gltf_["buffers"] = Tree::array({{{"byteLength", blob_.size()}}}); }

  std::filesystem::path path_;
  Tree gltf_;
  std::string blob_;
};

// Version 1 has objects where 2 has lists.
void require_version_2(const std::filesystem::path& path, const Tree& gltf) {
  const Tree& version = at(at(gltf, "asset"), "version");
  if (version.is_string() && version.get_ref<const std::string&>().starts_with("1"))
    throw Failure("is glTF of version 1", path.string(), "export it as glTF 2.0");
}

// Refuses a file where something else stands in the place of a list from which MARS takes items by their numbers.
void require_lists(const std::filesystem::path& path, const Tree& gltf) {
  for (const char* name : {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials",
                           "meshes", "nodes", "samplers", "scenes", "skins", "textures"})
    if (const Tree& list = at(gltf, name); !list.is_null() && !list.is_array())
      throw Failure(std::string("has ") + name + " that are no list", path.string(), "export it again");
}

}  // namespace

GltfBytes gltf_bytes(const std::filesystem::path& path, std::string bytes) {
  Tree gltf = gltf_json(bytes);
  require_version_2(path, gltf);
  require_lists(path, gltf);
  require_within_buffers(path, gltf);
  require_alike_attributes(path, gltf);
  const auto has_packed_view = [](const Tree& view) { return !packed_view(view).is_null(); };
  const std::set<std::size_t> accessors = packed_accessors(gltf);
  const Tree& views = at(gltf, "bufferViews");
  if (!views.is_array() || (accessors.empty() && std::ranges::none_of(views, has_packed_view)))
    return {std::move(bytes), std::make_unique<Tree>(std::move(gltf))};
  Unpacker unpacker(path, std::move(gltf));
  unpacker.unpack_views(bytes);
  if (!accessors.empty()) unpacker.make_floats(accessors);
  return unpacker.finish();
}

}  // namespace mars::importer
