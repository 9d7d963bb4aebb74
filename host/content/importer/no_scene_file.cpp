#include "hal/failure/failure.h"
#include "host/content/importer/scene_file.h"

namespace mars::importer {

MeshFile read_scene_file(const std::filesystem::path& path, FileKind, const MeshOptions&) {
  throw Failure("this MARS was built without Assimp, which reads such files", path.string(),
                "run ./bootstrap, which installs it (Debian: libassimp-dev) and builds MARS again; or export to PLY");
}

}  // namespace mars::importer
