#include "host/content/animator/motion/body/surface.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "host/content/modeler/bent_skin.h"

namespace mars::motion {
namespace {

constexpr int kGrid = 4;  // points along each side of a patch, of which a sole's shape is known

glm::dvec3 patch_point(const wire::Patch& patch, double u, double v) {
  const auto weights = [](double t) {
    const double r = 1 - t;
    return std::array{r * r * r, 3 * r * r * t, 3 * r * t * t, t * t * t};
  };
  const auto a = weights(u), b = weights(v);
  glm::dvec3 point(0);
  for (std::size_t i = 0; i < 16; ++i)
    for (int axis = 0; axis < 3; ++axis) point[axis] += a[i % 4] * b[i / 4] * patch.points[i][axis];
  return point;
}

void add_rigid(const modeler::Model& model, const Posture& posture, std::size_t number,
               std::vector<glm::dvec3>& points) {
  const modeler::Joint& joint = model.joints[number];
  const modeler::Axes frame = modeler::segment_frame(frame_in(model, posture, number), joint);
  const modeler::Box& box = joint.segment->sbb;
  const auto add = [&](const glm::dvec3& p) {
    points.push_back(frame.turn * (box.min + p * (box.max - box.min)) + frame.place);
  };
  const modeler::Shape& shape = model.shapes[joint.segment->shape];
  for (const wire::Patch& patch : shape.patches)
    for (int i = 0; i < kGrid; ++i)
      for (int j = 0; j < kGrid; ++j) add(patch_point(patch, double(i) / (kGrid - 1), double(j) / (kGrid - 1)));
  if (shape.mesh)
    for (const modeler::Mesh::Place& vertex : shape.mesh->vertices) add({vertex[0], vertex[1], vertex[2]});
}

// Of patches that follow a bone that counts.
void add_bent_patches(const modeler::ControlNet& net, const modeler::BentSkin& skin, const std::vector<bool>& counted,
                      std::vector<glm::dvec3>& points) {
  const std::vector<wire::Patch> bent = skin.patches_of(net);
  for (std::size_t number = 0; number < bent.size(); ++number)
    for (int i = 0; i < kGrid && counted[modeler::heaviest_bone(modeler::followed_by(net, net.patches[number][0]))];
         ++i)
      for (int j = 0; j < kGrid; ++j)
        points.push_back(patch_point(bent[number], double(i) / (kGrid - 1), double(j) / (kGrid - 1)));
}

void add_skin(const modeler::Model& model, const Posture& posture, const modeler::Joint& joint,
              const std::function<bool(std::size_t)>& counts, std::vector<glm::dvec3>& points) {
  std::vector<wire::Matrix> matrices;
  std::vector<bool> counted;
  for (const modeler::Bone& bone : joint.segment->bones) {
    matrices.push_back(modeler::bone_matrix(frame_in(model, posture, bone.joint), bone, joint));
    counted.push_back(counts(bone.joint));
  }
  const modeler::BentSkin skin(std::move(matrices), joint.segment->blend);
  const modeler::Shape& shape = model.shapes[joint.segment->shape];
  if (shape.net) return add_bent_patches(*shape.net, skin, counted, points);
  const modeler::Mesh& mesh = *shape.mesh;
  for (std::size_t vertex = 0; vertex < mesh.vertices.size(); ++vertex)
    if (counted[modeler::heaviest_bone(mesh.bones[vertex])])
      points.push_back(skin.place_of(mesh.vertices[vertex], mesh.bones[vertex]));
}

}  // namespace

std::vector<glm::dvec3> points_of(const modeler::Model& model, const Posture& posture,
                                  const std::function<bool(std::size_t)>& counts) {
  std::vector<glm::dvec3> points;
  for (std::size_t number = 0; number < model.joints.size(); ++number) {
    const modeler::Joint& joint = model.joints[number];
    if (!joint.segment) continue;
    if (!joint.segment->bones.empty())
      add_skin(model, posture, joint, counts, points);
    else if (counts(number))
      add_rigid(model, posture, number, points);
  }
  return points;
}

double reach_of_skin(const modeler::Model& model, std::size_t from, const glm::dvec3& direction,
                     const std::function<bool(std::size_t)>& counts) {
  const Posture drawn = drawn_posture(model);
  const glm::dvec3 origin = frame_in(model, drawn, from).place;
  std::vector<glm::dvec3> points;
  for (const modeler::Joint& joint : model.joints)
    if (joint.segment && !joint.segment->bones.empty()) add_skin(model, drawn, joint, counts, points);
  double most = 0;
  for (const glm::dvec3& point : points) most = std::max(most, glm::dot(point - origin, direction));
  return most;
}

}  // namespace mars::motion
