#include "hal/failure/failure.h"
#include "host/content/importer/scene_file.h"
#include "host/content/importer/scenes/scene_motion.h"

namespace mars::importer {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& path) {
  throw Failure("this MARS was built without Assimp, which reads such files", path.string(),
                "run ./bootstrap, which installs it (Debian: libassimp-dev) and builds MARS again; or export to PLY");
}

}  // namespace

MeshFile read_scene_file(const std::filesystem::path& path, FileKind, const MeshOptions&) { refuse(path); }

GltfScene read_scene_motion(const std::filesystem::path& path, const std::string&) { refuse(path); }

}  // namespace mars::importer
