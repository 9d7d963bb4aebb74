#include "host/content/importer/model_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "host/content/document/text.h"

namespace mars::importer {
namespace {

constexpr double kSameBind = 2e-6;  // what single precision leaves of a bind pose that is the pose at rest

// Of several meshes with the same bones.
bool are_alike(const modeler::Affine& a, const modeler::Affine& b) {
  bool alike = glm::length(a.place - b.place) < kSameBind * (1 + glm::length(a.place));
  for (int column = 0; column < 3; ++column) alike = alike && glm::length(a.turn[column] - b.turn[column]) < kSameBind;
  return alike;
}

}  // namespace

ModelBuilder::ModelBuilder(std::string file, const MeshOptions& options, bool has_normals, double usual_crease)
    : file_(std::move(file)),
      size_(options.size),
      has_normals_(has_normals),
      style_{has_normals && !options.crease, options.crease.value_or(usual_crease)} {}

std::size_t ModelBuilder::add_joint(const std::string& name, std::size_t parent, const JointFrame& frame,
                                    std::size_t node) {
  joints_.push_back({names_.unused(name), parent, frame, node, MeshBuilder(file_, style_)});
  return joints_.size() - 1;
}

std::uint32_t ModelBuilder::bone(std::size_t joint, const modeler::Affine& to_rest) {
  const auto known = std::ranges::find_if(
      bones_, [&](const DraftBone& each) { return each.joint == joint && are_alike(each.to_rest, to_rest); });
  if (known == bones_.end()) {
    bones_.push_back({joint, to_rest});
    return static_cast<std::uint32_t>(bones_.size() - 1);
  }
  return static_cast<std::uint32_t>(known - bones_.begin());
}

// By their joints, as a model has them.
void ModelBuilder::sort_bones() {
  std::vector<std::uint32_t> order(bones_.size()), numbers(bones_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t bone) { return bones_[bone].joint; });
  std::vector<DraftBone> sorted;
  for (const std::uint32_t bone : order) {
    numbers[bone] = static_cast<std::uint32_t>(sorted.size());
    sorted.push_back(bones_[bone]);
  }
  bones_ = std::move(sorted);
  joints_.front().mesh.renumber_bones(numbers);
}

// At rest joints stand unturned. Bones that leave the mesh where it is need not say so.
void ModelBuilder::finish_bones(double factor, const std::vector<std::size_t>& numbers, MeshFile& file) const {
  const double size = glm::length(file.extent);
  for (const DraftBone& bone : bones_) {
    const glm::dvec3 place = bone.to_rest.place - joints_[bone.joint].frame.origin;
    file.bones.push_back({numbers[bone.joint], {bone.to_rest.turn, place * factor}});
    for (int c = 0; c < 3; ++c) {
      glm::dvec3 column = bone.to_rest.turn[c];
      column[c] -= 1;
      file.are_bound_at_rest = file.are_bound_at_rest && glm::length(column) < kSameBind;
    }
    file.are_bound_at_rest = file.are_bound_at_rest && glm::length(bone.to_rest.place) * factor < kSameBind * size;
  }
}

void ModelBuilder::check_places(const modeler::Box& box) const {
  for (const glm::dvec3& corner : {box.min, box.max})
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(corner[axis]) <= document::kFarthest))
        throw Failure("has a vertex at " + document::shown(corner[axis]), file_,
                      "keep vertices within 1e9 of the origin, with a smaller --scale if need be");
}

// Further materials are joints of their own in the same place.
void ModelBuilder::finish_joint(Draft& draft, double factor, MeshFile& file) {
  const bool is_first = draft.parent == modeler::kNone;
  JointFrame frame = draft.frame;
  if (!is_first) frame.origin -= joints_[draft.parent].frame.origin;
  frame.origin *= factor;
  file.joints.push_back(
      {draft.name, is_first ? "" : joints_[draft.parent].name, frame, false, draft.limits, {}, false, draft.node});
  check_places({frame.origin, frame.origin});
  for (MeshPart& part : draft.mesh.finish(factor)) {
    if (file.joints.back().part)
      file.joints.push_back({names_.unused(draft.name), draft.name, {{}, frame.x_axis, frame.y_axis}, true, {}, {}});
    check_places(part.bounds);
    file.joints.back().part = std::move(part);
    file.joints.back().has_skin = draft.mesh.has_skin();
  }
}

MeshFile ModelBuilder::finish() {
  modeler::Box box = kEmptyBox;
  std::size_t left_out = 0;
  for (const Draft& draft : joints_) {
    draft.mesh.widen(box, draft.frame.origin, draft.frame.axes());
    left_out += draft.mesh.faces_left_out();
  }
  if (box.max.x < box.min.x)
    throw Failure("has no faces", file_, "export the object's surface, not only points or lines");
  MeshFile file;
  file.factor = size_.factor(box.max.z - box.min.z, file_);
  file.extent = (box.max - box.min) * file.factor;
  check_places({box.min * file.factor, box.max * file.factor});
  sort_bones();
  std::vector<std::size_t> numbers;  // of drafts, in the file
  for (Draft& draft : joints_) {
    numbers.push_back(file.joints.size());
    finish_joint(draft, file.factor, file);
  }
  finish_bones(file.factor, numbers, file);
  if (left_out > 0)
    file.not_read.push_back(document::counted(left_out, "face", "faces") + " without three different corners");
  if (has_normals_ && !style_.takes_normals) file.not_read.emplace_back("normals (--crease makes others)");
  return file;
}

}  // namespace mars::importer
