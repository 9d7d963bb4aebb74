#include "host/content/importer/gltf/meshopt_view.h"

#include <meshoptimizer.h>

namespace mars::importer {
namespace {

bool decode(const MeshoptView& view, std::string_view packed, std::string& bytes) {
  const auto* from = reinterpret_cast<const unsigned char*>(packed.data());
  switch (view.mode) {
    case MeshoptMode::attributes:
      return meshopt_decodeVertexBuffer(bytes.data(), view.count, view.stride, from, packed.size()) == 0;
    case MeshoptMode::triangles:
      return meshopt_decodeIndexBuffer(bytes.data(), view.count, view.stride, from, packed.size()) == 0;
    case MeshoptMode::indices:
      return meshopt_decodeIndexSequence(bytes.data(), view.count, view.stride, from, packed.size()) == 0;
  }
  return false;
}

void apply_filter(const MeshoptView& view, std::string& bytes) {
  switch (view.filter) {
    case MeshoptFilter::none: return;
    case MeshoptFilter::octahedral: return meshopt_decodeFilterOct(bytes.data(), view.count, view.stride);
    case MeshoptFilter::quaternion: return meshopt_decodeFilterQuat(bytes.data(), view.count, view.stride);
    case MeshoptFilter::exponential: return meshopt_decodeFilterExp(bytes.data(), view.count, view.stride);
  }
}

}  // namespace

std::string meshopt_unpacked(const std::filesystem::path&, const MeshoptView& view, std::string_view packed) {
  std::string bytes(view.count * view.stride, '\0');
  if (!decode(view, packed, bytes)) return "";
  apply_filter(view, bytes);
  return bytes;
}

}  // namespace mars::importer
