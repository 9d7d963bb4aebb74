// What EXT_meshopt_compression packs: the bytes of a buffer view (gltf/meshopt_view.cpp, the only code that uses
// meshoptimizer; a MARS that was built without it has no_meshopt_view.cpp).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace mars::importer {

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

struct MeshoptView {
  MeshoptMode mode;
  MeshoptFilter filter;
  std::size_t count;   // of elements
  std::size_t stride;  // bytes of each: of attributes a multiple of 4 up to 256, of indices 2 or 4
};

// count * stride bytes. `packed` is what the file has of them; "" where it is damaged. Throws Failure, about `path`,
// where MARS cannot unpack such views.
std::string meshopt_unpacked(const std::filesystem::path& path, const MeshoptView& view, std::string_view packed);

}  // namespace mars::importer
