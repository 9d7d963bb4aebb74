#include "host/content/importer/scene_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/importer/assimp_matrix.h"
#include "host/content/importer/gltf/gltf_bounds.h"
#include "host/content/importer/gltf_limbs.h"
#include "host/content/importer/gltf_skins.h"
#include "host/content/importer/joint_frame.h"
#include "host/content/importer/limbs/find_limbs.h"
#include "host/content/importer/material_reader.h"
#include "host/content/importer/model_builder.h"
#include "host/content/importer/node_tree.h"
#include "host/content/importer/promised.h"
#include "host/content/importer/scene_sources.h"
#include "host/content/importer/skin.h"
#include "host/content/importer/unread_parts.h"

namespace mars::importer {
namespace {

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
                               {"has the same name as", "two of its bones have one name"},
                               {"too small", "it is empty or cut short"},
                               {"is empty", "it is empty or cut short"},
                               {"unexpected EOF", "it is cut short"}};

// ": it has no meshes"; "" for what Assimp says of its inner workings only.
std::string reason_in_our_words(std::string_view message) {
  for (const Reason& reason : kReasons)
    if (message.find(reason.part) != std::string_view::npos) return std::string(": ") + reason.words;
  return "";
}

// Of a face that need not be plane, by Newell's sum; of length 1 where it has an area.
glm::dvec3 flat_normal(const std::vector<glm::dvec3>& places) {
  glm::dvec3 sum(0);
  for (std::size_t i = 1; i + 1 < places.size(); ++i)
    sum += glm::cross(places[i] - places[0], places[i + 1] - places[0]);
  const double length = glm::length(sum);
  return length > 0 ? sum / length : sum;
}

constexpr std::size_t kBonesOfFigures = 8;  // at least: a spine and two legs that bend

// What the file says without Assimp.
struct FileItself {
  FileItself(const std::filesystem::path& path, FileKind kind) {
    const std::string bytes = document::read_file(path, kLargestMeshFile);
    if (kind == FileKind::glb && bytes.size() >= 4 && !bytes.starts_with("glTF"))
      throw Failure("is no GLB file: it does not begin with glTF", path.string(), "name it by what it is");
    Tree gltf;
    if (is_gltf(kind)) gltf = gltf_json(bytes);
    require_within_buffers(path, gltf);
    promised = promised_by(path, kind, bytes, gltf);
    if (is_gltf(kind)) skins = gltf_skins(path, gltf);
    limbs = limb_map(gltf);
  }

  Promised promised;
  std::optional<GltfSkins> skins;
  std::optional<LimbMap> limbs;  // by the numbers of nodes
};

class SceneReader {
 public:
  SceneReader(const std::filesystem::path& path, FileKind kind, const MeshOptions& options)
      : path_(path),
        kind_(kind),
        options_(options),
        upright_(options.upright),
        file_(path, kind),
        sources_(handed_over(std::make_unique<SceneSources>(path))),
        scene_(load()),
        tree_(node_tree(path, scene_, file_.skins ? &*file_.skins : nullptr, options.rest)),
        materials_(path, kind, scene_),
        builder_(path.string(), options, has_normals(), is_gltf(kind) ? 0 : modeler::kDefaultCrease) {}

  MeshFile read() {
    check_faces();
    if (is_gltf(kind_))
      add_joints();
    else
      add_all_to_one();
    MeshFile file = builder_.finish();
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) file.vertices += scene_.mMeshes[i]->mNumVertices;
    file.vertices = file_.promised.vertices.value_or(file.vertices);
    file.materials = materials_.materials();
    file.limbs = named_limbs_;
    list_what_was_made(file);
    list_not_read(file.not_read);
    file.companions = sources_.companions();
    file.companions.insert(file.companions.end(), materials_.textures().companions().begin(),
                           materials_.textures().companions().end());
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

  // STL's are its facets'. A glTF mesh without normals has flat faces (glTF 2.0, 3.7.2.1), whatever others have.
  bool has_normals() const {
    const std::span meshes(scene_.mMeshes, scene_.mNumMeshes);
    if (kind_ == FileKind::stl) return false;
    return is_gltf(kind_) ? std::ranges::any_of(meshes, &aiMesh::HasNormals)
                          : std::ranges::all_of(meshes, &aiMesh::HasNormals);
  }

  void check_faces() const {
    std::size_t faces = 0;
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i)
      for (unsigned f = 0; f < scene_.mMeshes[i]->mNumFaces; ++f)
        faces += scene_.mMeshes[i]->mFaces[f].mNumIndices >= 3;
    if (file_.promised.faces.value_or(0) > faces)
      fail("promises " + std::to_string(*file_.promised.faces) + " faces, " + std::to_string(faces) +
               (faces == 1 ? " was read" : " were read"),
           "export it again, or as another of OBJ, STL, PLY, glTF, GLB");
  }

  // Of OBJ and STL, whose nodes have no places of their own.
  void add_all_to_one() {
    builder_.add_joint(options_.joint, modeler::kNone, {});
    for (const PlacedNode& node : tree_.nodes) {
      const glm::dmat4 matrix = upright_ * node.matrix;
      for (unsigned i = 0; i < node.node->mNumMeshes; ++i) add(*scene_.mMeshes[node.node->mMeshes[i]], 0, matrix);
    }
  }

  // Nodes with meshes below them become joints, and bones. What a skin places stands on the first joint.
  void add_joints() {
    const std::vector<bool> shown = shown_nodes();
    bones_ = static_cast<std::size_t>(std::ranges::count(bones(), true));
    limbs_ = find_limbs(figure_tree(shown), limb_map_of_nodes(), bones_ >= kBonesOfFigures);
    const bool one_root = !tree_.nodes.empty() && tree_.nodes[0].parent == modeler::kNone && shown[0] &&
                          file_.skins->roots.size() == 1 && !has_skins();
    if (!one_root) builder_.add_joint(options_.joint, modeler::kNone, {});
    std::vector<std::size_t> joints(tree_.nodes.size(), 0);
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
      const PlacedNode& node = tree_.nodes[i];
      if (shown[i]) {
        const std::size_t parent = node.parent == modeler::kNone ? 0 : joints[node.parent];
        joints[i] = add_joint(i, one_root && i == 0 ? modeler::kNone : parent);
      }
    }
    name_limbs(joints);
    nodes_as_joints_ = std::ranges::count(shown, true);
    std::vector<std::size_t> by_number(tree_.by_number.size(), 0);  // joints of the file's nodes
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i)
      if (tree_.nodes[i].number != modeler::kNone) by_number[tree_.nodes[i].number] = joints[i];
    for (const PlacedNode& node : tree_.nodes)
      if (node.skin) add_skinned(node, by_number);
  }

  bool has_skins() const {
    return std::ranges::any_of(tree_.nodes, [](const PlacedNode& node) { return node.skin.has_value(); });
  }

  bool has_faces(const PlacedNode& node) const {
    const auto is_face = [](const aiFace& face) { return face.mNumIndices >= 3; };
    return std::ranges::any_of(std::span(node.node->mMeshes, node.node->mNumMeshes), [&](unsigned number) {
      const aiMesh& mesh = *scene_.mMeshes[number];
      return std::ranges::any_of(std::span(mesh.mFaces, mesh.mNumFaces), is_face);
    });
  }

  // Of the file's nodes, those that are bones of a mesh.
  std::vector<bool> bones() const {
    std::vector<bool> bones(tree_.by_number.size());
    for (const PlacedNode& node : tree_.nodes) {
      if (!node.skin || !has_faces(node)) continue;
      for (const std::size_t number : file_.skins->skins[*node.skin]) bones[number] = true;
    }
    return bones;
  }

  // Those with a mesh of their own, or below them, that no skin places; and bones, with all above them.
  std::vector<bool> shown_nodes() const {
    const std::vector<bool> is_bone = bones();
    std::vector<bool> shown(tree_.nodes.size());
    for (std::size_t i = shown.size(); i-- > 0;) {
      const PlacedNode& node = tree_.nodes[i];
      if (!node.skin && has_faces(node)) shown[i] = true;
      if (node.number != modeler::kNone && is_bone[node.number]) shown[i] = true;
      if (shown[i] && node.parent != modeler::kNone) shown[node.parent] = true;
    }
    return shown;
  }

  // The nodes, of which those that become joints are a figure's.
  FigureTree figure_tree(const std::vector<bool>& shown) const {
    const std::vector<bool> is_bone = bones();
    FigureTree tree;
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
      const PlacedNode& node = tree_.nodes[i];
      const bool moves = (node.number != modeler::kNone && is_bone[node.number]) || (!node.skin && has_faces(node));
      tree.push_back({shown[i] ? node.name : "", shown[i] ? node.parent : modeler::kNone,
                      glm::dvec3(in_our_axes(node.matrix)[3]), shown[i] && moves});
    }
    return tree;
  }

  std::optional<LimbMap> limb_map_of_nodes() const {
    if (!file_.limbs) return std::nullopt;
    LimbMap map{file_.limbs->by, {}};
    for (const auto& [limb, number] : file_.limbs->limbs)
      for (std::size_t i = 0; i < tree_.nodes.size(); ++i)
        if (tree_.nodes[i].number == number) map.limbs.emplace_back(limb, i);
    return map;
  }

  // `joints`: the builder's, by node.
  void name_limbs(const std::vector<std::size_t>& joints) {
    for (const auto& [limb, node] : named(limbs_.limbs)) named_limbs_.push_back({limb, builder_.name_of(joints[node])});
  }

  // In the model's axes a node that the file does not turn has the model's.
  glm::dmat4 in_our_axes(const glm::dmat4& matrix) const { return upright_ * matrix * glm::transpose(upright_); }

  // A limb of a figure turns about a person's axes, whatever its node's are.
  std::size_t add_joint(std::size_t number, std::size_t parent) {
    const PlacedNode& node = tree_.nodes[number];
    const glm::dmat4 matrix = in_our_axes(node.matrix);
    const std::optional<JointAnatomy>& anatomy = limbs_.anatomy[number];
    glm::dmat4 turned = matrix;
    for (int axis = 0; axis < 3 && anatomy; ++axis) turned[axis] = glm::dvec4(anatomy->axes[axis], 0);
    const JointFrame frame = frame_of(turned);
    const std::string name = node.name.empty() ? "node" : node.name;
    const std::size_t joint =
        builder_.add_joint(parent == modeler::kNone ? options_.joint : name, parent, frame, node.number);
    if (anatomy && anatomy->limits) builder_.limit(joint, *anatomy->limits);
    uneven_joints_ += !scales_evenly(tree_.above(node));
    if (node.skin) return joint;  // its mesh stands elsewhere
    const glm::dmat4 within(within_frame(frame, glm::dmat3(matrix)) * glm::dmat3(upright_));
    for (unsigned i = 0; i < node.node->mNumMeshes; ++i) add(*scene_.mMeshes[node.node->mMeshes[i]], joint, within);
    return joint;
  }

  // The mesh stands where its heaviest bone puts it in the file. If the file's pose is the one in which the skin was
  // bound, so do all its bones.
  void add_skinned(const PlacedNode& node, const std::vector<std::size_t>& by_number) {
    const std::vector<std::size_t>& numbers = file_.skins->skins[*node.skin];
    std::vector<glm::dmat4> joints;
    for (const std::size_t number : numbers) joints.push_back(upright_ * tree_.by_number[number]);
    for (unsigned i = 0; i < node.node->mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[node.node->mMeshes[i]];
      MeshSkin skin = importer::skin_of(mesh, joints);
      glm::dmat4 to_model = skin.to_file[skin.heaviest];
      if (!(std::abs(glm::determinant(glm::dmat3(to_model))) > 0)) to_model = upright_;
      const glm::dmat4 back = glm::inverse(to_model);
      std::vector<std::uint32_t> bones;  // of the model, by the mesh's
      for (std::size_t bone = 0; bone < skin.to_file.size(); ++bone) {
        skin.to_file[bone] = skin.to_file[bone] * back;
        const glm::dmat4& matrix = skin.to_file[bone];
        bones.push_back(builder_.bone(bone < numbers.size() ? by_number[numbers[bone]] : 0,
                                      {glm::dmat3(matrix), glm::dvec3(matrix[3])}));
      }
      weights_left_out_ += skin.weights_left_out;
      add(mesh, 0, to_model, &skin, bones);
    }
    ++skinned_meshes_;
  }

  // A vertex of a skin that stands at `place`.
  static MeshBuilder::Follows follows(const MeshSkin& skin, std::span<const std::uint32_t> bones, unsigned vertex,
                                      const glm::dvec3& place) {
    MeshBuilder::Follows follows{skin.vertices[vertex], glm::dvec3(0)};
    for (std::size_t i = 0; i < modeler::kMostBonesOfVertex; ++i) {
      const std::uint32_t bone = follows.bones.bone[i];
      if (follows.bones.weight[i] == 0) continue;
      follows.at_rest += double(follows.bones.weight[i]) * glm::dvec3(skin.to_file[bone] * glm::dvec4(place, 1));
      follows.bones.bone[i] = bones[bone];
    }
    return follows;
  }

  // `matrix`, from the mesh's axes to the joint's; of a skin, whose bones have the numbers `bones`, to where it stands.
  void add(const aiMesh& mesh, std::size_t joint, const glm::dmat4& matrix, const MeshSkin* skin = nullptr,
           std::span<const std::uint32_t> bones = {}) {
    const glm::dmat3 linear(matrix);
    // Normals go by the inverse's transpose.
    const glm::dmat3 across = glm::determinant(linear) == 0 ? linear : glm::transpose(glm::inverse(linear));
    const bool mirrored = glm::determinant(across) < 0;
    MeshBuilder& builder = builder_.mesh(joint);
    const std::size_t part = builder.part_of(materials_.number_of(mesh));
    std::vector<std::uint32_t> face;
    std::vector<glm::dvec3> places;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const std::span corners(mesh.mFaces[f].mIndices, mesh.mFaces[f].mNumIndices);
      if (corners.size() < 3) continue;  // a point, a line
      places.clear();
      for (const unsigned corner : corners)
        places.emplace_back(matrix * glm::dvec4(dvec3_of(mesh.mVertices[corner]), 1));
      const glm::dvec3 flat = mesh.HasNormals() ? glm::dvec3(0) : flat_normal(places) * (mirrored ? -1.0 : 1.0);
      face.clear();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const unsigned corner = corners[i];
        const glm::dvec3 normal = mesh.HasNormals() ? across * dvec3_of(mesh.mNormals[corner]) : flat;
        if (skin == nullptr) {
          face.push_back(builder.vertex(part, places[i], normal));
          continue;
        }
        const MeshBuilder::Follows followed = follows(*skin, bones, corner, places[i]);
        face.push_back(builder.vertex(part, places[i], normal, &followed));
      }
      if (mirrored) std::ranges::reverse(face);
      builder.add_face(part, face);
    }
  }

  void list_what_was_made(MeshFile& file) const {
    const auto add = [&](const char* what, std::size_t count, std::string_view one, std::string_view several) {
      if (count > 0) file.made.push_back(what + document::counted(count, one, several));
    };
    add("joints of ", nodes_as_joints_ > 1 ? nodes_as_joints_ : 0, "node", "nodes");
    add("a skin, which ", file.bones.size(), "joint moves, of ", "joints move, of ");
    if (!file.bones.empty()) file.made.back() += document::counted(skinned_meshes_, "mesh", "meshes");
    if (!limbs_.limbs_made.empty()) file.made.push_back(limbs_.made() + remedy_of_guess());
    add("metallic-roughness of ",
        static_cast<std::size_t>(std::ranges::count_if(
            file.materials, [](const ImportedMaterial& material) { return material.surface.has_value(); })),
        "material", "materials");
    add("a mean colour of ", materials_.textures_of_colors(), "texture", "textures");
    add("a mean roughness and metal of ", materials_.textures_of_surfaces(), "texture", "textures");
  }

  // Guesses are to be checked.
  std::string remedy_of_guess() const {
    return limbs_.is_guess ? " (check them; name another: " + options_.set_limb + " left.hip)" : "";
  }

  void list_limbs(std::vector<std::string>& list) const {
    for (const std::string& doubt : limbs_.doubts) list.push_back("limbs: " + doubt);
    const bool names_none = limbs_.limbs_made.empty() && bones_ >= kBonesOfFigures;
    if (names_none) list.emplace_back("limbs: neither the joints' names nor the shape are a figure's");
    if (names_none || !limbs_.doubts.empty()) list.back() += " (name them: " + options_.set_limb + " left.hip)";
  }

  void list_not_read(std::vector<std::string>& list) const {
    list_limbs(list);
    if (uneven_joints_ > 0)
      list.push_back("an uneven scale above " + document::counted(uneven_joints_, "joint", "joints") +
                     ": turned, they keep their shape at rest");
    if (weights_left_out_ > 0)
      list.push_back(document::counted(weights_left_out_, "weight", "weights") +
                     " of vertices that follow more than 4 bones: the 4 heaviest count");
    append(list, unread_parts(scene_, materials_.textures(), options_.set_material, !options_.rest.empty()));
    append(list, materials_.textures().not_read());
    append(list, file_.promised.not_read);
    if (const std::size_t count = materials_.cut_colors(); count > 0)
      list.push_back(document::counted(count, "colour", "colours") + " beyond 0 to 1: cut to that" +
                     (options_.rest.empty() ? " (another: " + options_.set_material + " --color 0.8 0.6 0.4)" : ""));
  }

  std::filesystem::path path_;
  FileKind kind_;
  MeshOptions options_;
  glm::dmat4 upright_;
  FileItself file_;
  Assimp::Importer importer_;
  const SceneSources& sources_;  // the importer's
  const aiScene& scene_;
  NodeTree tree_;
  MaterialReader materials_;
  ModelBuilder builder_;
  std::size_t bones_ = 0;
  FiguresLimbs limbs_;  // of nodes
  std::vector<NamedLimb> named_limbs_;
  std::size_t nodes_as_joints_ = 0, skinned_meshes_ = 0, weights_left_out_ = 0, uneven_joints_ = 0;
};

}  // namespace

MeshFile read_scene_file(const std::filesystem::path& path, FileKind kind, const MeshOptions& options) {
  return SceneReader(path, kind, options).read();
}

}  // namespace mars::importer
