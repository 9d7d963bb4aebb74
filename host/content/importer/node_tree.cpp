#include "host/content/importer/node_tree.h"

#include "hal/failure/failure.h"
#include "host/content/importer/assimp_matrix.h"
#include "host/content/importer/scenes/scene_nodes.h"

namespace mars::importer {
namespace {

const glm::dmat4 kIdentity(1);

class TreeReader {
 public:
  TreeReader(const std::filesystem::path& path, const GltfSkins* skins, std::span<const glm::dmat4> rest)
      : path_(path), skins_(skins), rest_(rest) {}

  // Assimp makes the one root node of a glTF scene its own, and puts a node of its own above several, as above those of
  // FBX and COLLADA.
  NodeTree read(const aiNode& root) {
    if (skins_ == nullptr) {
      visit(root, modeler::kNone, kIdentity);
      return std::move(tree_);
    }
    tree_.by_number.resize(skins_->nodes.size(), kIdentity);
    const bool is_root = skins_->is_by_mesh ? skins_->roots == std::vector<std::size_t>{0} : skins_->roots.size() == 1;
    if (skins_->is_by_mesh) tree_.by_number[0] = skins_->above;
    if (is_root)
      visit_numbered(root, modeler::kNone, kIdentity, skins_->roots[0]);
    else
      visit_children(root, modeler::kNone, skins_->above, skins_->roots);
    return std::move(tree_);
  }

 private:
  std::size_t add(const aiNode& node, std::size_t parent, const glm::dmat4& matrix) {
    if (tree_.nodes.size() == kMostNodes)
      throw Failure("has more than a million nodes", path_.string(), "join its objects before exporting it");
    tree_.nodes.push_back({&node, parent, matrix, "", {}});
    return tree_.nodes.size() - 1;
  }

  void visit(const aiNode& node, std::size_t parent, const glm::dmat4& above) {
    const std::size_t index = add(node, parent, above * dmat4_of(node.mTransformation));
    const glm::dmat4 matrix = tree_.nodes[index].matrix;
    for (unsigned i = 0; i < node.mNumChildren; ++i) visit(*node.mChildren[i], index, matrix);
  }

  void visit_numbered(const aiNode& node, std::size_t parent, const glm::dmat4& above, std::size_t number) {
    const bool is_above = skins_->is_by_mesh && number == 0;
    const glm::dmat4 own = is_above ? skins_->above : rest_.empty() ? dmat4_of(node.mTransformation) : rest_[number];
    const std::size_t index = add(node, parent, above * own);
    const GltfNode& gltf = skins_->nodes[number];
    tree_.nodes[index].name = gltf.name;
    tree_.nodes[index].skin = gltf.skin;
    tree_.nodes[index].number = number;
    tree_.nodes[index].is_pivot = is_pivot(gltf.name);
    const glm::dmat4 matrix = tree_.by_number[number] = tree_.nodes[index].matrix;
    visit_children(node, index, matrix, gltf.children);
  }

  void visit_children(const aiNode& node, std::size_t parent, const glm::dmat4& above,
                      const std::vector<std::size_t>& numbers) {
    if (node.mNumChildren != numbers.size())
      throw Failure("has nodes that cannot be followed", path_.string(), "export it again");
    for (unsigned i = 0; i < node.mNumChildren; ++i) visit_numbered(*node.mChildren[i], parent, above, numbers[i]);
  }

  const std::filesystem::path& path_;
  const GltfSkins* skins_;
  std::span<const glm::dmat4> rest_;
  NodeTree tree_;
};

}  // namespace

const glm::dmat4& NodeTree::above(const PlacedNode& node) const {
  return node.parent == modeler::kNone ? kIdentity : nodes[node.parent].matrix;
}

NodeTree node_tree(const std::filesystem::path& path, const aiScene& scene, const GltfSkins* skins,
                   std::span<const glm::dmat4> rest) {
  return TreeReader(path, skins, rest).read(*scene.mRootNode);
}

}  // namespace mars::importer
