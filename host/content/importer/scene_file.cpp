#include "host/content/importer/scene_file.h"

#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <exception>
#include <memory>
#include <set>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/importer/mesh_builder.h"
#include "host/content/importer/promised.h"
#include "host/content/importer/scene_sources.h"
#include "host/content/importer/unread_parts.h"

namespace mars::importer {
namespace {

constexpr std::size_t kMostNodes = 1'000'000;

using Vector = aiVector3t<double>;
using Matrix = aiMatrix4x4t<double>;

glm::dvec3 dvec3_of(const Vector& vector) { return {vector.x, vector.y, vector.z}; }

void append(std::vector<std::string>& list, const std::vector<std::string>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

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
                               {"too small", "it is empty or cut short"},
                               {"is empty", "it is empty or cut short"},
                               {"unexpected EOF", "it is cut short"}};

// ": it has no meshes"; "" for what Assimp says of its inner workings only.
std::string reason_in_our_words(std::string_view message) {
  for (const Reason& reason : kReasons)
    if (message.find(reason.part) != std::string_view::npos) return std::string(": ") + reason.words;
  return "";
}

class SceneReader {
 public:
  SceneReader(const std::filesystem::path& path, FileKind kind, const MeshOptions& options)
      : path_(path),
        kind_(kind),
        set_material_(options.set_material),
        is_gltf_(kind == FileKind::gltf || kind == FileKind::glb),
        promised_(promised_by(path, kind)),
        sources_(handed_over(std::make_unique<SceneSources>(path))),
        scene_(load()),
        builder_(path.string(), options, has_normals()) {}

  MeshFile read() {
    check_faces();
    visit(*scene_.mRootNode, Matrix());
    MeshFile file = builder_.finish(is_gltf_ ? 0 : modeler::kDefaultCrease);
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) file.vertices += scene_.mMeshes[i]->mNumVertices;
    file.vertices = promised_.vertices.value_or(file.vertices);
    append(file.not_read, unread_parts(scene_, is_gltf_, set_material_));
    append(file.not_read, promised_.not_read);
    if (!cut_colors_.empty())
      file.not_read.push_back(document::counted(cut_colors_.size(), "colour", "colours") +
                              " beyond 0 to 1: cut to that (another: " + set_material_ + " --color 0.8 0.6 0.4)");
    file.companions = sources_.companions();
    return file;
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Failure(problem, path_.string(), remedy);
  }

  // No steps of Assimp's own but its check of indices: joining, splitting and smoothing are ours.
  const aiScene& load() {
    const aiScene* scene = importer_.ReadFile(path_.string(), aiProcess_ValidateDataStructure);
    if (scene && scene->mRootNode) return *scene;
    rethrow_ours();
    if (!sources_.not_opened().empty())
      throw Failure("cannot be read", sources_.not_opened().back().string(),
                    path_.string() + " names it: check that it is there, and its permissions");
    fail("is no sound mesh file" + reason_in_our_words(importer_.GetErrorString()),
         "export it again, or as another of OBJ, STL, PLY, glTF, GLB");
  }

  const SceneSources& handed_over(std::unique_ptr<SceneSources> sources) {
    const SceneSources& handed = *sources;
    importer_.SetIOHandler(sources.release());
    return handed;
  }

  // Those that the system and SceneSources threw; what Assimp says of its own load() puts in other words.
  void rethrow_ours() const {
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

  // STL's are its facets'.
  bool has_normals() const {
    bool all = kind_ != FileKind::stl;
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) all &= scene_.mMeshes[i]->HasNormals();
    return all;
  }

  void check_faces() const {
    std::size_t faces = 0;
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i)
      for (unsigned f = 0; f < scene_.mMeshes[i]->mNumFaces; ++f)
        faces += scene_.mMeshes[i]->mFaces[f].mNumIndices >= 3;
    if (promised_.faces.value_or(0) > faces)
      fail("promises " + std::to_string(*promised_.faces) + " faces, " + std::to_string(faces) +
               (faces == 1 ? " was read" : " were read"),
           "export it again, or as another of OBJ, STL, PLY, glTF, GLB");
  }

  void visit(const aiNode& node, const Matrix& above) {
    if (++visited_ > kMostNodes) fail("has more than a million nodes", "join its objects before exporting it");
    const auto matrix = above * static_cast<Matrix>(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene_.mMeshes[node.mMeshes[i]], matrix);
    for (unsigned i = 0; i < node.mNumChildren; ++i) visit(*node.mChildren[i], matrix);
  }

  void add(const aiMesh& mesh, const Matrix& matrix) {
    const bool mirrored = matrix.Determinant() < 0;
    auto across = aiMatrix3x3t<double>(matrix);  // normals go by the inverse's transpose
    if (across.Determinant() != 0) across.Inverse().Transpose();
    const std::size_t part = builder_.part_of(color_of(mesh));
    std::vector<std::uint32_t> face;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      if (mesh.mFaces[f].mNumIndices < 3) continue;  // a point, a line
      face.clear();
      for (unsigned c = 0; c < mesh.mFaces[f].mNumIndices; ++c) {
        const unsigned index = mesh.mFaces[f].mIndices[c];
        const Vector normal = mesh.HasNormals() ? across * static_cast<Vector>(mesh.mNormals[index]) : Vector();
        face.push_back(
            builder_.vertex(part, dvec3_of(matrix * static_cast<Vector>(mesh.mVertices[index])), dvec3_of(normal)));
      }
      if (mirrored) std::reverse(face.begin(), face.end());
      builder_.add_face(part, face);
    }
  }

  // OBJ's colour is as shown, glTF's is light.
  MeshBuilder::Color color_of(const aiMesh& mesh) {
    if (kind_ == FileKind::stl) return {};
    const aiMaterial& material = *scene_.mMaterials[mesh.mMaterialIndex];
    aiColor4D given;
    if (material.GetName() == aiString(AI_DEFAULT_MATERIAL_NAME)) return {};
    if (material.Get(AI_MATKEY_BASE_COLOR, given) != AI_SUCCESS &&
        material.Get(AI_MATKEY_COLOR_DIFFUSE, given) != AI_SUCCESS)
      return {};
    std::array<double, 3> color{given.r, given.g, given.b};
    if (std::any_of(color.begin(), color.end(), [](double c) { return !(c >= 0 && c <= 1); }))
      cut_colors_.insert(mesh.mMaterialIndex);
    for (double& c : color) {
      c = c >= 0 ? std::min(c, 1.0) : 0;
      if (is_gltf_) c = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
      c = std::round(c * 1000) / 1000;
    }
    return color;
  }

  std::filesystem::path path_;
  FileKind kind_;
  std::string set_material_;
  bool is_gltf_;
  Promised promised_;
  Assimp::Importer importer_;
  const SceneSources& sources_;  // the importer's
  const aiScene& scene_;
  MeshBuilder builder_;
  std::size_t visited_ = 0;
  std::set<unsigned> cut_colors_;  // numbers of materials
};

}  // namespace

MeshFile read_scene_file(const std::filesystem::path& path, FileKind kind, const MeshOptions& options) {
  return SceneReader(path, kind, options).read();
}

}  // namespace mars::importer
