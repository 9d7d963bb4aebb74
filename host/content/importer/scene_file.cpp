#include "host/content/importer/scene_file.h"

#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/importer/assimp_matrix.h"
#include "host/content/importer/gltf/unpacked_gltf.h"
#include "host/content/importer/gltf_limbs.h"
#include "host/content/importer/gltf_skins.h"
#include "host/content/importer/joint_frame.h"
#include "host/content/importer/limbs/find_limbs.h"
#include "host/content/importer/material_reader.h"
#include "host/content/importer/model_builder.h"
#include "host/content/importer/node_tree.h"
#include "host/content/importer/orientation.h"
#include "host/content/importer/paint.h"
#include "host/content/importer/motions/spindles.h"
#include "host/content/importer/promised.h"
#include "host/content/importer/loaded_scene.h"
#include "host/content/importer/scene_nodes.h"
#include "host/content/importer/skin.h"
#include "host/content/importer/unread_parts.h"

namespace mars::importer {
namespace {

void append(std::vector<std::string>& list, const std::vector<std::string>& more) {
  list.insert(list.end(), more.begin(), more.end());
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
    std::string bytes = document::read_file(path, kLargestMeshFile);
    if (kind == FileKind::glb && bytes.size() >= 4 && !bytes.starts_with("glTF"))
      throw Failure("is no GLB file: it does not begin with glTF", path.string(), "name it by what it is");
    Tree gltf;
    bool is_unpacked = false;
    if (is_gltf(kind)) {
      GltfBytes given = gltf_bytes(path, std::move(bytes));
      bytes = std::move(given.bytes);
      gltf = std::move(*given.gltf);
      is_unpacked = given.unpacked;
    }
    promised = promised_by(path, kind, bytes, gltf);
    if (is_unpacked) unpacked = std::move(bytes);
    if (is_gltf(kind)) skins = gltf_skins(path, gltf);
    limbs = limb_map(gltf);
  }

  std::string unpacked;  // a GLB in place of the file; "": Assimp can read the file itself
  Promised promised;
  std::optional<GltfSkins> skins;  // of scenes; FBX's and COLLADA's are known when Assimp has read them
  std::optional<LimbMap> limbs;    // by the numbers of nodes
};

class SceneReader {
 public:
  SceneReader(const std::filesystem::path& path, FileKind kind, const MeshOptions& options)
      : path_(path),
        kind_(kind),
        options_(options),
        upright_(options.upright),
        file_(path, kind),
        loaded_(path, std::move(file_.unpacked)),
        scene_(loaded_.scene()),
        is_skeleton_(is_skeleton()),
        tree_(node_tree(path, scene_, skins(), options.rest)),
        materials_(path, kind, scene_, options.images_folder),
        builder_(path.string(), options, has_normals(), is_gltf(kind) || is_skeleton_ ? 0 : modeler::kDefaultCrease) {}

  MeshFile read() {
    check_faces();
    if (has_nodes(kind_))
      add_joints();
    else
      add_all_to_one();
    MeshFile file = builder_.finish();
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) file.vertices += scene_.mMeshes[i]->mNumVertices;
    file.vertices = file_.promised.vertices.value_or(file.vertices);
    file.materials = is_skeleton_ ? std::vector<ImportedMaterial>{{kColorOfBones, {}, {}}} : materials_.materials();
    file.limbs = named_limbs_;
    list_what_was_made(file);
    list_not_read(file.not_read);
    file.companions = loaded_.sources().companions();
    file.companions.insert(file.companions.end(), materials_.means().companions().begin(),
                           materials_.means().companions().end());
    file.images = std::move(materials_.images().images());
    for (const KeptImage& image : file.images)
      if (!image.from.empty()) file.companions.push_back(image.from);
    return file;
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Failure(problem, path_.string(), remedy);
  }

  // Whether it has nodes alone, such as a motion that was exported without its figure.
  bool is_skeleton() const {
    if (!has_nodes(kind_) || is_gltf(kind_)) return false;
    return std::ranges::none_of(std::span(scene_.mMeshes, scene_.mNumMeshes), has_faces_itself);
  }

  const GltfSkins* skins() {
    if (has_nodes(kind_) && !is_gltf(kind_)) file_.skins = scene_skins(scene_, scene_nodes(path_, scene_));
    return file_.skins ? &*file_.skins : nullptr;
  }

  // STL's are its facets'. A glTF mesh without normals has flat faces (glTF 2.0, 3.7.2.1), whatever others have.
  bool has_normals() const {
    const std::span meshes(scene_.mMeshes, scene_.mNumMeshes);
    if (kind_ == FileKind::stl) return false;
    return has_nodes(kind_) ? std::ranges::any_of(meshes, &aiMesh::HasNormals)
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
           std::string("export it again, or as another of ") + kMeshKinds);
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
    find_limbs(shown);
    if (options_.looks_ahead) look_ahead(shown);
    const bool one_root = !tree_.nodes.empty() && tree_.nodes[0].parent == modeler::kNone && shown[0] &&
                          file_.skins->roots.size() == 1 && !has_skins() && !is_skeleton_ && !tree_.nodes[0].is_pivot;
    if (!one_root) builder_.add_joint(options_.joint, modeler::kNone, {});
    std::vector<std::size_t> joints(tree_.nodes.size(), 0);
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
      const PlacedNode& node = tree_.nodes[i];
      if (!shown[i]) continue;
      const std::size_t parent = node.parent == modeler::kNone ? 0 : joints[node.parent];
      joints[i] = node.is_pivot ? parent : add_joint(i, one_root && i == 0 ? modeler::kNone : parent);
      nodes_as_joints_ += !node.is_pivot;
    }
    name_limbs(joints);
    if (is_skeleton_) add_spindles(shown, joints);
    std::vector<std::size_t> by_number(tree_.by_number.size(), 0);  // joints of the file's nodes
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i)
      if (tree_.nodes[i].number != modeler::kNone) by_number[tree_.nodes[i].number] = joints[i];
    for (const PlacedNode& node : tree_.nodes)
      if (node.skin) add_skinned(node, by_number);
  }

  void find_limbs(const std::vector<bool>& shown) {
    limbs_ = importer::find_limbs(figure_tree(shown), limb_map_of_nodes(), bones_ >= kBonesOfFigures);
  }

  void look_ahead(const std::vector<bool>& shown) {
    const auto front = front_of(figure_tree(shown), limbs_.limbs);
    if (!front || front->x == 1) return;
    looks_along_ = axis_name(glm::transpose(glm::dmat3(upright_)) * *front);
    const glm::dmat3 ahead(*front, glm::cross(glm::dvec3(0, 0, 1), *front), glm::dvec3(0, 0, 1));
    upright_ = glm::dmat4(glm::transpose(ahead)) * upright_;
    find_limbs(shown);
  }

  bool has_skins() const {
    return std::ranges::any_of(tree_.nodes, [](const PlacedNode& node) { return node.skin.has_value(); });
  }

  static bool has_faces_itself(const aiMesh* mesh) {
    const auto is_face = [](const aiFace& face) { return face.mNumIndices >= 3; };
    return std::ranges::any_of(std::span(mesh->mFaces, mesh->mNumFaces), is_face);
  }

  // Of glTF, all meshes of a node; FBX and COLLADA may have others beside them.
  bool has_skin(const PlacedNode& node, unsigned mesh) const {
    return node.skin && (is_gltf(kind_) || scene_.mMeshes[mesh]->HasBones());
  }

  // In meshes with a skin, or in those without.
  bool has_faces(const PlacedNode& node, bool with_skin) const {
    return std::ranges::any_of(std::span(node.node->mMeshes, node.node->mNumMeshes), [&](unsigned mesh) {
      return has_skin(node, mesh) == with_skin && has_faces_itself(scene_.mMeshes[mesh]);
    });
  }

  // The file's nodes that are the bones of a node's mesh, in the order of Assimp's bones.
  const std::vector<std::size_t>& bones_of(const PlacedNode& node, unsigned mesh) const {
    return file_.skins->skins[file_.skins->is_by_mesh ? mesh : *node.skin];
  }

  // Of the file's nodes, those that are bones of a mesh.
  std::vector<bool> bones() const {
    std::vector<bool> bones(tree_.by_number.size());
    for (const PlacedNode& node : tree_.nodes) {
      for (unsigned i = 0; i < node.node->mNumMeshes; ++i) {
        const unsigned mesh = node.node->mMeshes[i];
        if (!has_skin(node, mesh) || !has_faces_itself(scene_.mMeshes[mesh])) continue;
        for (const std::size_t number : bones_of(node, mesh)) bones[number] = true;
      }
    }
    return bones;
  }

  // Those with a mesh of their own, or below them, that no skin places; and bones, with all above them.
  std::vector<bool> shown_nodes() const {
    if (is_skeleton_) return skeleton_nodes();
    const std::vector<bool> is_bone = bones();
    std::vector<bool> shown(tree_.nodes.size());
    for (std::size_t i = shown.size(); i-- > 0;) {
      const PlacedNode& node = tree_.nodes[i];
      if (has_faces(node, false)) shown[i] = true;
      if (node.number != modeler::kNone && is_bone[node.number]) shown[i] = true;
      if (shown[i] && node.parent != modeler::kNone) shown[node.parent] = true;
    }
    return shown;
  }

  // Those that hang together: cameras, lights and what they look at stand alone.
  std::vector<bool> skeleton_nodes() const {
    std::vector<std::size_t> root(tree_.nodes.size()), count(tree_.nodes.size());
    for (std::size_t i = 0; i < root.size(); ++i) {
      root[i] = tree_.nodes[i].parent == modeler::kNone ? i : root[tree_.nodes[i].parent];
      count[root[i]] += !tree_.nodes[i].is_pivot;
    }
    const bool all = std::ranges::none_of(count, [](std::size_t nodes) { return nodes > 1; });
    std::vector<bool> shown;
    for (const std::size_t each : root) shown.push_back(all || count[each] > 1);
    return shown;
  }

  std::size_t above_pivots(std::size_t node) const {
    std::size_t above = tree_.nodes[node].parent;
    while (above != modeler::kNone && tree_.nodes[above].is_pivot) above = tree_.nodes[above].parent;
    return above;
  }

  // Bones to be seen, for a skeleton without a figure. `joints`: the builder's, by node.
  void add_spindles(const std::vector<bool>& shown, const std::vector<std::size_t>& joints) {
    const auto place = [&](std::size_t node) { return glm::dvec3(in_our_axes(tree_.nodes[node].matrix)[3]); };
    std::vector<std::vector<glm::dvec3>> ends(tree_.nodes.size());
    modeler::Box box = kEmptyBox;
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
      if (!shown[i] || tree_.nodes[i].is_pivot) continue;
      box = {glm::min(box.min, place(i)), glm::max(box.max, place(i))};
      if (const std::size_t above = above_pivots(i); above != modeler::kNone)
        ends[above].push_back(place(i) - place(above));
    }
    const double size = glm::length(box.max - box.min);
    if (!(size > 0)) fail("has no meshes, and nodes at one place only", "export its figure with it");
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i)
      if (shown[i] && !tree_.nodes[i].is_pivot) add_spindles(spindles_of(ends[i], size), joints[i]);
  }

  void add_spindles(const Spindles& spindles, std::size_t joint) {
    if (spindles.faces.empty()) return;
    MeshBuilder& builder = builder_.mesh(joint);
    const glm::dmat3 to_axes = glm::transpose(builder_.axes_of(joint));
    const std::size_t part = builder.part_of(0);
    std::vector<std::uint32_t> face;
    for (const auto& corners : spindles.faces) {
      face.clear();
      for (const std::size_t corner : corners)
        face.push_back(builder.corner(part, to_axes * spindles.vertices[corner], glm::dvec3(0)));
      builder.add_face(part, face);
    }
  }

  // The nodes, of which those that become joints are a figure's.
  FigureTree figure_tree(const std::vector<bool>& shown) const {
    const std::vector<bool> is_bone = bones();
    FigureTree tree;
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
      const PlacedNode& node = tree_.nodes[i];
      const bool moves =
          is_skeleton_ || (node.number != modeler::kNone && is_bone[node.number]) || has_faces(node, false);
      const bool is_joint = shown[i] && !node.is_pivot;
      tree.push_back({is_joint ? node.name : "", is_joint ? above_pivots(i) : modeler::kNone,
                      glm::dvec3(in_our_axes(node.matrix)[3]), is_joint && moves});
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
    std::map<std::size_t, int> limbs_of;  // by joint; of several limbs that are one joint, none is named
    for (const auto& [limb, node] : named(limbs_.limbs)) ++limbs_of[joints[node]];
    for (const auto& [limb, node] : named(limbs_.limbs))
      if (limbs_of[joints[node]] == 1) named_limbs_.push_back({limb, builder_.name_of(joints[node])});
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
    const glm::dmat4 within(within_frame(frame, glm::dmat3(matrix)) * glm::dmat3(upright_));
    for (unsigned i = 0; i < node.node->mNumMeshes; ++i)
      if (const unsigned mesh = node.node->mMeshes[i]; !has_skin(node, mesh))  // else it stands elsewhere
        add(*scene_.mMeshes[mesh], joint, within);
    return joint;
  }

  // The mesh stands where its heaviest bone puts it in the file. If the file's pose is the one in which the skin was
  // bound, so do all its bones.
  void add_skinned(const PlacedNode& node, const std::vector<std::size_t>& by_number) {
    for (unsigned i = 0; i < node.node->mNumMeshes; ++i) {
      if (!has_skin(node, node.node->mMeshes[i])) continue;
      const aiMesh& mesh = *scene_.mMeshes[node.node->mMeshes[i]];
      const std::vector<std::size_t>& numbers = bones_of(node, node.node->mMeshes[i]);
      std::vector<glm::dmat4> joints;
      for (const std::size_t number : numbers) joints.push_back(upright_ * tree_.by_number[number]);
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
      boneless_ += skin.boneless;
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
      for (const unsigned corner : corners) places.emplace_back(matrix * glm::dvec4(morphed(mesh, corner), 1));
      const glm::dvec3 flat = mesh.HasNormals() ? glm::dvec3(0) : flat_normal(places) * (mirrored ? -1.0 : 1.0);
      face.clear();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const unsigned corner = corners[i];
        const glm::dvec3 normal = mesh.HasNormals() ? across * dvec3_of(mesh.mNormals[corner]) : flat;
        const CornerPaint paint = paint_of(mesh, corner);
        if (skin == nullptr) {
          face.push_back(builder.corner(part, places[i], normal, nullptr, paint));
          continue;
        }
        const MeshBuilder::Follows followed = follows(*skin, bones, corner, places[i]);
        face.push_back(builder.corner(part, places[i], normal, &followed, paint));
      }
      if (mirrored) std::ranges::reverse(face);
      builder.add_face(part, face);
    }
  }

  // v upward, as Assimp turns that of glTF; colours as shown, as those of materials.
  CornerPaint paint_of(const aiMesh& mesh, unsigned vertex) const {
    CornerPaint paint;
    if (mesh.HasTextureCoords(0)) {
      const aiVector3D& uv = mesh.mTextureCoords[0][vertex];
      paint.uv = place_in_image(uv.x, uv.y);
    }
    if (mesh.HasVertexColors(0)) {
      const aiColor4D& color = mesh.mColors[0][vertex];
      const bool is_light = is_gltf(kind_);
      paint.color = {shown_part(color.r, is_light), shown_part(color.g, is_light), shown_part(color.b, is_light),
                     shown_part(color.a, false)};
    }
    return paint;
  }

  // Of glTF, with the targets at the weights that the mesh has; Assimp gives their places, not what they add.
  glm::dvec3 morphed(const aiMesh& mesh, unsigned vertex) const {
    const glm::dvec3 own = dvec3_of(mesh.mVertices[vertex]);
    glm::dvec3 place = own;
    for (unsigned i = 0; is_gltf(kind_) && i < mesh.mNumAnimMeshes; ++i)
      if (const aiAnimMesh& target = *mesh.mAnimMeshes[i]; target.HasPositions() && target.mWeight != 0)
        place += double(target.mWeight) * (dvec3_of(target.mVertices[vertex]) - own);
    return place;
  }

  // Morph targets that change the shape at rest.
  std::size_t targets_at_rest() const {
    std::size_t count = 0;
    for (const aiMesh* mesh : std::span(scene_.mMeshes, scene_.mNumMeshes))
      for (unsigned i = 0; is_gltf(kind_) && i < mesh->mNumAnimMeshes; ++i)
        count += mesh->mAnimMeshes[i]->HasPositions() && mesh->mAnimMeshes[i]->mWeight != 0;
    return count;
  }

  void list_what_was_made(MeshFile& file) const {
    const auto add = [&](const char* what, std::size_t count, std::string_view one, std::string_view several) {
      if (count > 0) file.made.push_back(what + document::counted(count, one, several));
    };
    add("joints of ", nodes_as_joints_ > 1 ? nodes_as_joints_ : 0, "node", "nodes");
    add("a skin, which ", file.bones.size(), "joint moves, of ", "joints move, of ");
    if (!file.bones.empty()) file.made.back() += document::counted(skinned_meshes_, "mesh", "meshes");
    if (!limbs_.limbs_made.empty()) file.made.push_back(limbs_.made() + remedy_of_guess());
    if (!looks_along_.empty()) file.made.push_back("turned to look along x (--front " + looks_along_ + ")");
    add("metallic-roughness of ",
        static_cast<std::size_t>(std::ranges::count_if(
            file.materials, [](const ImportedMaterial& material) { return material.surface.has_value(); })),
        "material", "materials");
    add("the shape at the file's weights of ", targets_at_rest(), "morph target", "morph targets");
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
    if (boneless_ > 0)
      list.push_back("bones of " + document::counted(boneless_, "vertex", "vertices") +
                     " without sound weights: the first bone of the skin moves these");
    append(list, unread_parts(scene_, materials_, options_.set_material, !options_.rest.empty()));
    append(list, materials_.means().not_read());
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
  LoadedScene loaded_;
  const aiScene& scene_;
  bool is_skeleton_;
  NodeTree tree_;
  MaterialReader materials_;
  ModelBuilder builder_;
  std::size_t bones_ = 0;
  FiguresLimbs limbs_;       // of nodes
  std::string looks_along_;  // the file's axis, if the figure was turned
  std::vector<NamedLimb> named_limbs_;
  std::size_t nodes_as_joints_ = 0, skinned_meshes_ = 0, weights_left_out_ = 0, boneless_ = 0, uneven_joints_ = 0;
};

}  // namespace

MeshFile read_scene_file(const std::filesystem::path& path, FileKind kind, const MeshOptions& options) {
  return SceneReader(path, kind, options).read();
}

}  // namespace mars::importer
