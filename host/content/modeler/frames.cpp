#include "host/content/modeler/frames.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "host/content/elementary/elementary.h"
#include "host/content/modeler/bent_skin.h"

namespace mars::modeler {
namespace {

constexpr int kSteps = 8;  // of a patch's sides, where its surface is measured

glm::dmat3 rotation_of(const glm::dvec3& n, double sine, double cosine) {
  const glm::dmat3 cross(0, n.z, -n.y, -n.z, 0, n.x, n.y, -n.x, 0);
  return cosine * glm::dmat3(1) + (1 - cosine) * glm::outerProduct(n, n) + sine * cross;
}

std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

glm::dvec3 point_of(const wire::Patch& patch, double u, double v) {
  const auto along_u = bernstein(u), along_v = bernstein(v);
  glm::dvec3 point(0);
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& control = patch.points[4 * j + i];
      point += along_u[i] * along_v[j] * glm::dvec3(control[0], control[1], control[2]);
    }
  return point;
}

std::vector<glm::dvec3> surface_points(const Shape& shape) {
  std::vector<glm::dvec3> points;
  for (const wire::Patch& patch : shape.patches)
    for (int j = 0; j <= kSteps; ++j)
      for (int i = 0; i <= kSteps; ++i) points.push_back(point_of(patch, double(i) / kSteps, double(j) / kSteps));
  if (shape.mesh)
    for (const Mesh::Place& vertex : shape.mesh->vertices) points.emplace_back(vertex[0], vertex[1], vertex[2]);
  return points;
}

// Where a skin's surface is.
std::vector<glm::dvec3> skin_at_rest(const Model& model, const Joint& joint, const std::vector<Axes>& frames) {
  std::vector<wire::Matrix> bones;
  for (const Bone& bone : joint.segment->bones) bones.push_back(bone_matrix(frames[bone.joint], bone, joint));
  const BentSkin skin(std::move(bones), joint.segment->blend);
  const Shape& shape = model.shapes[joint.segment->shape];
  if (shape.net) return surface_points({"", skin.patches_of(*shape.net)});
  std::vector<glm::dvec3> places;
  for (std::size_t vertex = 0; vertex < shape.mesh->vertices.size(); ++vertex)
    places.push_back(skin.place_of(shape.mesh->vertices[vertex], shape.mesh->bones[vertex]));
  return places;
}

void grow(std::optional<Box>& box, const Box& by) {
  box = box ? Box{glm::min(box->min, by.min), glm::max(box->max, by.max)} : by;
}

}  // namespace

glm::dmat3 rotation(const glm::dvec3& axis, double angle) {
  return rotation_of(axis, elementary::sin(angle), elementary::cos(angle));
}

glm::dmat3 rotation_by_degrees(const glm::dvec3& axis, double degrees) {
  constexpr double sines[] = {0, 1, 0, -1};
  int quarter = 0;
  const double rest = std::remquo(degrees, 90.0, &quarter);
  if (rest == 0) return rotation_of(axis, sines[quarter & 3], sines[(quarter + 1) & 3]);
  return rotation(axis, degrees * kDegree);
}

glm::dmat3 orientation(const Joint& joint, const glm::dvec3& pose) {
  const glm::dvec3 z_axis = glm::normalize(glm::cross(joint.x_axis, joint.y_axis));
  return rotation_by_degrees(joint.x_axis, pose.x) * rotation_by_degrees(joint.y_axis, pose.y) *
         rotation_by_degrees(z_axis, pose.z);
}

glm::dmat3 segment_axes(const Joint& joint) {
  return {joint.x_axis, joint.y_axis, glm::cross(joint.x_axis, joint.y_axis)};
}

Axes segment_frame(const Axes& joint_frame, const Joint& joint) {
  return {joint_frame.turn * segment_axes(joint), joint_frame.place};
}

Axes joint_frame(const Axes& segment, const Joint& joint) {
  return {segment.turn * glm::inverse(segment_axes(joint)), segment.place};
}

Affine product(const Affine& outer, const Affine& inner) {
  return {outer.turn * inner.turn, outer.turn * inner.place + outer.place};
}

Affine inverse(const Affine& map) {
  const glm::dmat3 back = glm::inverse(map.turn);
  return {back, -(back * map.place)};
}

Affine bind_at_rest(const Axes& bone, const Axes& joint) {
  return product(inverse({bone.turn, bone.place}), {joint.turn, joint.place});
}

wire::Matrix bone_matrix(const Axes& frame, const Bone& bone, const Joint& joint) {
  const Affine map = product(product({frame.turn, frame.place}, bone.bind), {segment_axes(joint), glm::dvec3(0)});
  return t_matrix({map.turn, map.place}, joint.segment->sbb);
}

std::uint32_t last_bone(const Shape& shape) {
  std::uint32_t last = 0;
  const auto look = [&](std::span<const VertexBones> points) { last = std::max(last, all_bones(points).back()); };
  if (shape.mesh) look(shape.mesh->bones);
  if (shape.net) look(shape.net->bones);
  return last;
}

wire::Matrix t_matrix(const Axes& frame, const Box& sbb) {
  const glm::dvec3 extent = sbb.max - sbb.min;
  const glm::dvec3 origin = frame.turn * sbb.min + frame.place;
  wire::Matrix matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix.m[row][column] = frame.turn[column][row] * extent[column];
    matrix.m[row][3] = origin[row];
  }
  return matrix;
}

std::vector<Axes> rest_frames(const Model& model) {
  std::vector<Axes> frames;
  for (const Joint& joint : model.joints) {
    const Axes parent = joint.parent == kNone ? Axes{} : frames[joint.parent];
    frames.push_back({parent.turn * orientation(joint, joint.rest()), parent.turn * joint.place + parent.place});
  }
  return frames;
}

std::vector<std::optional<Box>> segment_rest_bounds(const Model& model) {
  const std::vector<Axes> frames = rest_frames(model);
  std::vector<std::vector<glm::dvec3>> points;
  for (const Shape& shape : model.shapes) points.push_back(surface_points(shape));
  std::vector<std::optional<Box>> bounds(frames.size());
  for (std::size_t number = 0; number < frames.size(); ++number) {
    const Joint& joint = model.joints[number];
    if (!joint.segment) continue;
    const Axes frame = segment_frame(frames[number], joint);
    if (!joint.segment->bones.empty()) {
      for (const glm::dvec3& at : skin_at_rest(model, joint, frames)) grow(bounds[number], {at, at});
      continue;
    }
    const Box& sbb = joint.segment->sbb;
    for (const glm::dvec3& point : points[joint.segment->shape]) {
      const glm::dvec3 at = frame.turn * (sbb.min + point * (sbb.max - sbb.min)) + frame.place;
      grow(bounds[number], {at, at});
    }
  }
  return bounds;
}

std::optional<Box> rest_bounds(const Model& model) {
  std::optional<Box> all;
  for (const auto& bounds : segment_rest_bounds(model))
    if (bounds) grow(all, *bounds);
  return all;
}

}  // namespace mars::modeler
