#include "host/content/importer/loaded_scene.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <exception>
#include <memory>
#include <new>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/importer/file_kind.h"

namespace mars::importer {
namespace {

struct Reason {
  std::string_view part;  // of Assimp's message
  const char* words;
};

constexpr Reason kReasons[] = {{"mNumMeshes is 0", "it has no meshes"},
                               {"No scene", "it has no scene"},
                               {"contains no faces", "a mesh has no faces"},
                               {"no vertices", "a mesh has no vertices"},
                               {" is a POINT", "a face has one corner"},
                               {" is a LINE", "a face has two corners"},
                               {"mNumChannels is 0", "an animation moves nothing"},
                               {"Invalid face index", "a face has a corner that is not in the file"},
                               {"index out of range", "a face has a corner that is not in the file"},
                               {"exceeds size of actual data", "a buffer is shorter than it should be"},
                               {"missing the \"uri\"", "a buffer names no file"},
                               {"with offset/", "numbers are beyond the end of their buffer"},
                               {"JSON parse error", "it is not JSON, or cut short"},
                               {"JSON document", "it is not as glTF should be"},
                               {"Unsupported glTF version", "its version of glTF is not known"},
                               {"has the same name as", "two of its bones have one name"},
                               {"unsupported, old format", "its version of FBX is older than 6.1"},
                               {"unsupported, newer format", "its version of FBX is not known"},
                               {"too small", "it is empty or cut short"},
                               {"is empty", "it is empty or cut short"},
                               {"unexpected EOF", "it is cut short"},
                               {"unexpected end of file", "it is cut short"},
                               {"FBX", "it is not as FBX should be"},
                               {"Collada", "it is not as COLLADA should be"}};

// ": it has no meshes"; "" for what Assimp says of its inner workings only.
std::string reason_in_our_words(std::string_view message) {
  for (const Reason& reason : kReasons)
    if (message.find(reason.part) != std::string_view::npos) return std::string(": ") + reason.words;
  return "";
}

// Assimp reads what a name's ending says; of .vrm it knows nothing.
std::filesystem::path called(std::filesystem::path path, bool is_glb) {
  return is_glb || kind_of_name(path) == FileKind::glb ? path.replace_extension(".glb") : path;
}

}  // namespace

// No steps of Assimp's own but its check of indices: joining, splitting and smoothing are ours. What turns FBX's nodes
// about points of their own stays in nodes of its own, for Assimp's animations of one node would lose it.
LoadedScene::LoadedScene(const std::filesystem::path& path, std::string unpacked)
    : path_(path),
      name_(called(path, !unpacked.empty())),
      sources_(handed_over(std::make_unique<SceneSources>(path, name_, std::move(unpacked)))) {
  importer_.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
  importer_.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  scene_ = importer_.ReadFile(name_, aiProcess_ValidateDataStructure);
  if (scene_ == nullptr || scene_->mRootNode == nullptr) refuse();
}

const SceneSources& LoadedScene::handed_over(std::unique_ptr<SceneSources> sources) {
  const SceneSources& handed = *sources;
  importer_.SetIOHandler(sources.release());
  return handed;
}

// Those that the system and SceneSources threw; what Assimp says of its own refuse() puts in other words.
void LoadedScene::rethrow_ours() const {
  if (!importer_.GetException()) return;
  try {
    std::rethrow_exception(importer_.GetException());
  } catch (const Failure&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
  }
}

void LoadedScene::refuse() const {
  rethrow_ours();
  if (!sources_.not_opened().empty())
    throw Failure("cannot be read", sources_.not_opened().back().string(),
                  path_.string() + " names it: check that it is there, and its permissions");
  throw Failure("is no sound mesh file" + reason_in_our_words(importer_.GetErrorString()), path_.string(),
                std::string("export it again, or as another of ") + kMeshKinds);
}

}  // namespace mars::importer
