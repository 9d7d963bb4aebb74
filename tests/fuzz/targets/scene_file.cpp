// Mesh files that Assimp reads, which runs in a limited process of its own: whatever becomes of that one, `mars import`
// ends with a message. The input's first word is the ending that the file gets.
#include <algorithm>
#include <array>
#include <chrono>

#include "hal/failure/failure.h"
#include "host/content/importer/import_file.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::scene_file {
namespace {

constexpr std::array<std::string_view, 8> kEndings{"obj", "stl", "gltf", "glb", "fbx", "dae", "ply", "bpt"};

}  // namespace

void take(std::string_view input) {
  const std::size_t end = std::min(input.find('\n'), input.size());
  const auto ending = std::ranges::find(kEndings, input.substr(0, end));
  const std::string name = "mesh." + std::string(ending == kEndings.end() ? "obj" : *ending);
  const auto path = scratch().file(name, input.substr(std::min(end + 1, input.size())));
  importer::ImportOptions options;
  options.from = path;
  options.to = scratch().path("model.json");
  options.joint = "mesh";
  options.force = true;
  importer::import_model(options);
}

const Target target("scene_file", Form::text, take);

}  // namespace mars::fuzz::scene_file
