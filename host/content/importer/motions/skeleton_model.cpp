#include "host/content/importer/motions/skeleton_model.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/written.h"
#include "host/content/importer/motions/spindles.h"
#include "host/content/modeler/frames.h"

namespace mars::importer {
namespace {

using document::Json;

Json vector_text(const glm::dvec3& vector) { return animator::written(animator::rounded(vector)); }

// Into the unit cube, along the joint's axes.
Json segment_of(Spindles spindles, const modeler::Joint& joint, const std::string& shape, Json& shapes) {
  const glm::dmat3 to_axes = glm::transpose(modeler::segment_axes(joint));
  for (glm::dvec3& vertex : spindles.vertices) vertex = to_axes * vertex;
  modeler::Box box{spindles.vertices[0], spindles.vertices[0]};
  for (const glm::dvec3& vertex : spindles.vertices) {
    box.min = glm::min(box.min, vertex);
    box.max = glm::max(box.max, vertex);
  }
  Json vertices = Json::array(), faces = Json::array();
  for (const glm::dvec3& vertex : spindles.vertices) {
    Json row = Json::array();
    for (int axis = 0; axis < 3; ++axis)
      row.push_back(
          animator::written(static_cast<float>((vertex[axis] - box.min[axis]) / (box.max[axis] - box.min[axis]))));
    vertices.push_back(row);
  }
  for (const auto& face : spindles.faces) faces.push_back(face);
  shapes[shape] = Json{{"mesh", {{"vertices", vertices}, {"faces", faces}, {"crease", 0}}}};
  return {{"shape", shape}, {"sbb", Json::array({vector_text(box.min), vector_text(box.max)})}, {"material", "bone"}};
}

Json limits_of(const modeler::Joint& joint) {
  Json limits = Json::object();
  for (int axis = 0; axis < 3; ++axis)
    if (joint.limits[axis].free())
      limits[std::string(1, "xyz"[axis])] =
          Json::array({animator::written(joint.limits[axis].lower), animator::written(joint.limits[axis].upper)});
  return limits;
}

Json joint_text(const modeler::Joint& joint, const std::vector<modeler::Joint>& joints) {
  Json json{{"name", joint.name}};
  const modeler::Joint usual;
  if (joint.parent != modeler::kNone) json["parent"] = joints[joint.parent].name;
  if (joint.place != usual.place) json["place"] = vector_text(joint.place);
  if (joint.x_axis != usual.x_axis) json["x_axis"] = vector_text(joint.x_axis);
  if (joint.y_axis != usual.y_axis) json["y_axis"] = vector_text(joint.y_axis);
  const bool usual_limits = std::ranges::all_of(joint.limits, [&](const modeler::Limits& limits) {
    return limits.lower == usual.limits[0].lower && limits.upper == usual.limits[0].upper;
  });
  if (!usual_limits) json["limits"] = limits_of(joint);
  return json;
}

}  // namespace

Json skeleton_model(const Skeleton& skeleton, const std::string& file) {
  const SkeletonBox box = rest_box(skeleton);
  const double size = glm::length(box.max - box.min);
  if (!(size > 0)) throw Failure("has bones without length only", file, "export the skeleton with its offsets");
  std::vector<std::vector<glm::dvec3>> ends = skeleton.ends;
  for (const modeler::Joint& joint : skeleton.joints)
    if (joint.parent != modeler::kNone) ends[joint.parent].push_back(joint.place);
  Json joints = Json::array(), shapes = Json::object();
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const modeler::Joint& joint = skeleton.joints[i];
    Json json = joint_text(joint, skeleton.joints);
    Spindles spindles = spindles_of(ends[i], size);
    if (!spindles.vertices.empty())
      json["segment"] = segment_of(std::move(spindles), joint, joint.name + "-bone", shapes);
    joints.push_back(json);
  }
  return {{"materials", {{"bone", {{"color", kColorOfBones}}}}}, {"joints", joints}, {"shapes", shapes}};
}

}  // namespace mars::importer
