// Puts a mesh file's joints together and makes the model as large as a person wants it.
#pragma once

#include <string>
#include <vector>

#include "host/content/importer/imported_mesh.h"
#include "host/content/importer/joint_frame.h"
#include "host/content/importer/joint_names.h"
#include "host/content/importer/mesh_builder.h"

namespace mars::importer {

class ModelBuilder {
 public:
  // `file` is what failures name. `usual_crease`: of meshes without normals, unless the options have one.
  ModelBuilder(std::string file, const MeshOptions& options, bool has_normals, double usual_crease);

  // A joint's number; the first has no parent. Its frame is in the file's units. The name is made one that no other
  // joint has and that a model can have. `node`: of the file, which it is.
  std::size_t add_joint(const std::string& name, std::size_t parent, const JointFrame& frame,
                        std::size_t node = modeler::kNone);

  // How far the joint turns, as a limb of a figure.
  void limit(std::size_t joint, const std::array<modeler::Limits, 3>& limits) { joints_[joint].limits = limits; }
  const std::string& name_of(std::size_t joint) const { return joints_[joint].name; }
  glm::dmat3 axes_of(std::size_t joint) const { return joints_[joint].frame.axes(); }

  MeshBuilder& mesh(std::size_t joint) { return joints_[joint].mesh; }

  // The number of a bone whose joint moves the skin of the first joint; `to_rest` leads from the axes of that joint to
  // where the bone puts the mesh while the model rests, in the file's units. Alike ones are one bone.
  std::uint32_t bone(std::size_t joint, const modeler::Affine& to_rest);

  // Joints and their size; as not read, what was given here and left out. Refuses a file without faces.
  MeshFile finish();

 private:
  struct Draft {
    std::string name;
    std::size_t parent;
    JointFrame frame;
    std::size_t node;
    MeshBuilder mesh;
    std::optional<std::array<modeler::Limits, 3>> limits{};
  };

  struct DraftBone {
    std::size_t joint;
    modeler::Affine to_rest;
  };

  void check_places(const modeler::Box& box) const;
  void finish_joint(Draft& draft, double factor, MeshFile& file);
  void sort_bones();
  void finish_bones(double factor, const std::vector<std::size_t>& numbers, MeshFile& file) const;

  std::string file_;
  ModelSize size_;
  bool has_normals_;
  MeshStyle style_;
  std::vector<Draft> joints_;
  std::vector<DraftBone> bones_;
  JointNames names_;
};

}  // namespace mars::importer
