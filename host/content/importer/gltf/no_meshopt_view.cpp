#include "hal/failure/failure.h"
#include "host/content/importer/gltf/meshopt_view.h"

namespace mars::importer {

std::string meshopt_unpacked(const std::filesystem::path& path, const MeshoptView&, std::string_view) {
  throw Failure(
      "is packed as EXT_meshopt_compression, and this MARS was built without meshoptimizer", path.string(),
      "run ./bootstrap, which installs it (Debian: libmeshoptimizer-dev) and builds MARS again; or unpack the "
      "file: gltfpack -noq -i in.glb -o out.glb");
}

}  // namespace mars::importer
