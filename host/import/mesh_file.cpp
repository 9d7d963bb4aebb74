#include "host/import/mesh_file.h"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cctype>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <unordered_map>

#include "hal/failure.h"
#include "host/document/fields.h"

namespace mars::host {
namespace {

constexpr std::string_view kEndings[] = {".obj", ".stl", ".ply", ".gltf", ".glb"};
constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 30;
constexpr std::size_t kMostNodes = 1'000'000;

using Vector = aiVector3t<double>;
using Color = std::optional<std::array<double, 3>>;

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

// A mesh being put together: vertices that agree in place and normal are one.
struct Gathered {
  struct Vertex {
    Vector place, normal;
    auto key() const { return std::array{place.x, place.y, place.z, normal.x, normal.y, normal.z}; }
  };
  struct Hash {
    std::size_t operator()(const std::array<double, 6>& key) const {
      std::size_t sum = 0;
      for (const double number : key) sum = sum * 0x9e3779b97f4a7c15u + std::hash<double>()(number);
      return sum ^ sum >> 29;
    }
  };

  std::vector<Vertex> vertices;
  std::unordered_map<std::array<double, 6>, std::uint32_t, Hash> numbers;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> ends;

  std::uint32_t number_of(const Vertex& vertex) {
    const auto [at, is_new] = numbers.try_emplace(vertex.key(), static_cast<std::uint32_t>(vertices.size()));
    if (is_new) vertices.push_back(vertex);
    return at->second;
  }
};

class MeshFileReader {
 public:
  explicit MeshFileReader(const std::filesystem::path& path)
      : path_(path), ending_(ending_of(path)), is_gltf_(ending_ == ".gltf" || ending_ == ".glb") {}

  MeshFile read() {
    const aiScene* scene = load();
    scene_ = scene;
    takes_normals_ = ending_ != ".stl";  // STL's are its facets'
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) takes_normals_ &= scene->mMeshes[i]->HasNormals();
    // glTF's x, y, z are ours x, z, -y.
    const aiMatrix4x4t<double> upright =
        is_gltf_ ? aiMatrix4x4t<double>(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1) : aiMatrix4x4t<double>();
    visit(*scene->mRootNode, upright);
    return scaled();
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Failure(problem, path_.string(), remedy);
  }

  // No steps of Assimp's own but its check of indices: joining, splitting and smoothing are ours.
  const aiScene* load() {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(path_, error);
    if (error) fail("cannot be read: " + error.message(), "name a mesh file that is there");
    if (bytes > kLargestFile) fail("has more than 1 GiB", "make the mesh coarser, or split it");
    const aiScene* scene = importer_.ReadFile(path_.string(), aiProcess_ValidateDataStructure);
    if (!scene || !scene->mRootNode) {
      std::string why = importer_.GetErrorString();
      if (why.size() > 160) why = why.substr(0, 160) + " ...";
      std::replace_if(why.begin(), why.end(), [](unsigned char c) { return std::iscntrl(c); }, ' ');
      fail("is no sound mesh file: " + why, "export it again, or as another of OBJ, STL, PLY, glTF, GLB");
    }
    return scene;
  }

  void visit(const aiNode& node, const aiMatrix4x4t<double>& above) {
    if (++visited_ > kMostNodes) fail("has more than a million nodes", "join its objects before exporting it");
    const auto matrix = above * static_cast<aiMatrix4x4t<double>>(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene_->mMeshes[node.mMeshes[i]], matrix);
    for (unsigned i = 0; i < node.mNumChildren; ++i) visit(*node.mChildren[i], matrix);
  }

  void add(const aiMesh& mesh, const aiMatrix4x4t<double>& matrix) {
    const bool mirrored = matrix.Determinant() < 0;
    auto across = aiMatrix3x3t<double>(matrix);  // normals go by the inverse's transpose
    if (across.Determinant() != 0) across.Inverse().Transpose();
    Gathered& part = parts_[part_of(color_of(mesh))].second;
    std::vector<std::uint32_t> face;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      face.clear();
      for (unsigned c = 0; c < mesh.mFaces[f].mNumIndices; ++c) {
        const unsigned index = mesh.mFaces[f].mIndices[c];
        Gathered::Vertex vertex{matrix * static_cast<Vector>(mesh.mVertices[index]), {}};
        if (takes_normals_) vertex.normal = across * static_cast<Vector>(mesh.mNormals[index]);
        check_finite(vertex);
        face.push_back(part.number_of(vertex));
      }
      if (mirrored) std::reverse(face.begin(), face.end());
      add_face(face, part);
    }
  }

  void check_finite(Gathered::Vertex& vertex) const {
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (!(std::abs(vertex.place[axis]) <= kFarthest))
        fail("has a vertex at " + shown(vertex.place[axis]), "keep vertices within 1e9 of the origin");
      if (!(std::abs(vertex.normal[axis]) <= 1e6)) vertex.normal = {};
      vertex.place[axis] += 0.0;  // no negative zero
    }
  }

  static void add_face(std::vector<std::uint32_t>& face, Gathered& part) {
    face.erase(std::unique(face.begin(), face.end()), face.end());
    while (face.size() > 1 && face.front() == face.back()) face.pop_back();
    std::vector<std::uint32_t> different = face;
    std::sort(different.begin(), different.end());
    if (std::unique(different.begin(), different.end()) - different.begin() < 3) return;
    part.corners.insert(part.corners.end(), face.begin(), face.end());
    part.ends.push_back(static_cast<std::uint32_t>(part.corners.size()));
  }

  // OBJ's colour is as shown, glTF's is light.
  Color color_of(const aiMesh& mesh) const {
    if (ending_ != ".obj" && !is_gltf_) return {};
    const aiMaterial& material = *scene_->mMaterials[mesh.mMaterialIndex];
    aiColor4D given;
    if (material.GetName() == aiString(AI_DEFAULT_MATERIAL_NAME)) return {};
    if (material.Get(AI_MATKEY_BASE_COLOR, given) != AI_SUCCESS &&
        material.Get(AI_MATKEY_COLOR_DIFFUSE, given) != AI_SUCCESS)
      return {};
    std::array<double, 3> color{given.r, given.g, given.b};
    for (double& c : color) {
      c = c >= 0 ? std::min(c, 1.0) : 0;
      if (is_gltf_) c = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
      c = std::round(c * 1000) / 1000;
    }
    return color;
  }

  std::size_t part_of(const Color& color) {
    const auto same = [&](const auto& part) { return part.first == color; };
    const auto found = std::find_if(parts_.begin(), parts_.end(), same);
    if (found != parts_.end()) return static_cast<std::size_t>(found - parts_.begin());
    parts_.emplace_back(color, Gathered{});
    return parts_.size() - 1;
  }

  // Round what lies on faces; where that is flat, the box is one unit thick and it lies on the lower side.
  Box bounds() const {
    Box box{glm::dvec3(std::numeric_limits<double>::max()), glm::dvec3(std::numeric_limits<double>::lowest())};
    for (const auto& [color, part] : parts_)
      for (const std::uint32_t corner : part.corners)
        for (int axis = 0; axis < 3; ++axis) {
          const double at = part.vertices[corner].place[static_cast<unsigned>(axis)];
          box.min[axis] = std::min(box.min[axis], at);
          box.max[axis] = std::max(box.max[axis], at);
        }
    for (int axis = 0; axis < 3; ++axis)
      if (box.min[axis] == box.max[axis]) box.max[axis] += 1;
    return box;
  }

  MeshFile scaled() {
    std::erase_if(parts_, [](const auto& part) { return part.second.ends.empty(); });
    if (parts_.empty()) fail("has no faces", "export the object's surface, not only points or lines");
    MeshFile file{{}, bounds()};
    for (const auto& [color, part] : parts_) file.parts.push_back({color, mesh_of(part, file.bounds)});
    return file;
  }

  Mesh mesh_of(const Gathered& part, const Box& bounds) const {
    Mesh mesh;
    mesh.crease = is_gltf_ ? 0 : kDefaultCrease;
    const glm::dvec3 extent = bounds.max - bounds.min;
    for (const Gathered::Vertex& vertex : part.vertices) {
      const glm::dvec3 place(vertex.place.x, vertex.place.y, vertex.place.z);
      // In doubles the largest may come out of the cube by a rounding.
      const glm::dvec3 unit = glm::clamp((place - bounds.min) / extent, 0.0, 1.0);
      mesh.vertices.push_back({float(unit.x), float(unit.y), float(unit.z)});
      // Normals shrink where places grow.
      if (takes_normals_) mesh.normals.push_back(unit_normal(vertex.normal, extent));
    }
    for (std::size_t face = 0, first = 0; face < part.ends.size(); first = part.ends[face++])
      add_to(mesh, std::vector(part.corners.begin() + std::ptrdiff_t(first), part.corners.begin() + part.ends[face]));
    return mesh;
  }

  static Mesh::Place unit_normal(const Vector& normal, const glm::dvec3& extent) {
    const glm::dvec3 n(normal.x * extent.x, normal.y * extent.y, normal.z * extent.z);
    const double length = glm::length(n);
    return length > 0 ? Mesh::Place{float(n.x / length), float(n.y / length), float(n.z / length)} : Mesh::Place{};
  }

  // A face that cannot be drawn as it stands is added in triangles.
  static void add_to(Mesh& mesh, std::vector<std::uint32_t> face) {
    if (!mesh.normals.empty() && turned_inside(mesh, face)) std::reverse(face.begin(), face.end());
    const auto add = [&](std::initializer_list<std::uint32_t> corners) {
      if (std::max(corners) == std::min(corners)) return;
      mesh.corners.insert(mesh.corners.end(), corners);
      mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    };
    if (face.size() == 3 || (face.size() <= kMostCorners && split(mesh, face))) {
      mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
      mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
      return;
    }
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      if (face[0] != face[k] && face[k] != face[k + 1] && face[0] != face[k + 1]) add({face[0], face[k], face[k + 1]});
  }

  std::filesystem::path path_;
  std::string ending_;
  bool is_gltf_;
  Assimp::Importer importer_;
  const aiScene* scene_ = nullptr;
  bool takes_normals_ = false;
  std::size_t visited_ = 0;
  std::vector<std::pair<Color, Gathered>> parts_;
};

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  return std::find(std::begin(kEndings), std::end(kEndings), ending) != std::end(kEndings);
}

MeshFile read_mesh_file(const std::filesystem::path& path) { return MeshFileReader(path).read(); }

}  // namespace mars::host
