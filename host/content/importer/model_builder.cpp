#include "host/content/importer/model_builder.h"

#include <algorithm>
#include <cmath>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "host/content/document/text.h"

namespace mars::importer {
ModelBuilder::ModelBuilder(std::string file, const MeshOptions& options, bool has_normals, double usual_crease)
    : file_(std::move(file)),
      size_(options.size),
      has_normals_(has_normals),
      style_{has_normals && !options.crease, options.crease.value_or(usual_crease)} {}

std::size_t ModelBuilder::add_joint(const std::string& name, std::size_t parent, const JointFrame& frame) {
  joints_.push_back({names_.unused(name), parent, frame, MeshBuilder(file_, style_)});
  return joints_.size() - 1;
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
  file.joints.push_back({draft.name, is_first ? "" : joints_[draft.parent].name, frame, false, {}});
  check_places({frame.origin, frame.origin});
  for (MeshPart& part : draft.mesh.finish(factor)) {
    if (file.joints.back().part)
      file.joints.push_back({names_.unused(draft.name), draft.name, {{}, frame.x_axis, frame.y_axis}, true, {}});
    check_places(part.bounds);
    file.joints.back().part = std::move(part);
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
  for (Draft& draft : joints_) finish_joint(draft, file.factor, file);
  if (left_out > 0)
    file.not_read.push_back(document::counted(left_out, "face", "faces") + " without three different corners");
  if (has_normals_ && !style_.takes_normals) file.not_read.emplace_back("normals (--crease makes others)");
  return file;
}

}  // namespace mars::importer
