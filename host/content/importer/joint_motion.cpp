#include "host/content/importer/joint_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "host/content/animator/pose/angles.h"
#include "host/content/elementary/elementary.h"

namespace mars::importer {
namespace {

constexpr double kSlides = 1e-4;  // of the model's size
constexpr double kScaled = 1e-4;
constexpr double kFlat = 1e-9;  // a determinant of what has lost a dimension

std::vector<glm::dvec3> corners_of(const modeler::Box& box) {
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z);
  return corners;
}

double distance(const glm::dmat3& one, const glm::dmat3& other) {
  double greatest = 0;
  for (int column = 0; column < 3; ++column) greatest = std::max(greatest, glm::length(one[column] - other[column]));
  return greatest;
}

// The rotation of a polar decomposition, by Newton's way (Higham, "Computing the polar decomposition", 1986); none of
// what is flat or mirrors.
std::optional<glm::dmat3> rotation_in(const glm::dmat3& linear) {
  if (!(glm::determinant(linear) > kFlat * elementary::pow(distance(linear, glm::dmat3(0)), 3))) return std::nullopt;
  glm::dmat3 turn = linear;
  for (int step = 0; step < 60; ++step) {
    const glm::dmat3 next = 0.5 * (turn + glm::transpose(glm::inverse(turn)));
    const bool done = distance(next, turn) < 1e-15;
    turn = next;
    if (done) break;
  }
  return turn;
}

glm::dmat4 translation(const glm::dvec3& by) {
  glm::dmat4 matrix(1);
  matrix[3] = glm::dvec4(by, 1);
  return matrix;
}

glm::dvec3 moved(const glm::dmat4& by, const glm::dvec3& point) { return {by * glm::dvec4(point, 1)}; }

}  // namespace

JointMotions::JointMotions(const MeshFile& model, const NodesInFilm& nodes, const std::vector<glm::dmat4>& rest)
    : nodes_(nodes), nodes_at_rest_(nodes.at_rest(rest)), size_(glm::length(model.extent)) {
  std::map<std::string_view, std::size_t> numbers;
  for (const MeshJoint& written : model.joints) {
    const std::size_t parent = written.parent.empty() ? modeler::kNone : numbers.at(written.parent);
    const glm::dmat3 axes = written.frame.axes();
    modeler::Joint joint{written.name, parent, written.frame.origin, axes[0], axes[1], {}, {}};
    if (written.fixed) joint.limits.fill({0, 0});
    numbers.emplace(written.name, joints_.size());
    origins_.push_back((parent == modeler::kNone ? glm::dvec3(0) : origins_[parent]) + joint.place);
    node_of_.push_back(written.node);
    joints_.push_back(std::move(joint));
  }
  add_boxes(model);
}

void JointMotions::widen(std::size_t joint, const glm::dvec3& point) {
  std::optional<modeler::Box>& box = carries_[joint];
  box = box ? modeler::Box{glm::min(box->min, point), glm::max(box->max, point)} : modeler::Box{point, point};
}

void JointMotions::add_boxes(const MeshFile& model) {
  carries_.resize(joints_.size());
  needs_matrix_.resize(joints_.size());
  for (const MeshBone& bone : model.bones) needs_matrix_[bone.joint] = true;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    const MeshJoint& written = model.joints[joint];
    if (!written.part) continue;
    needs_matrix_[joint] = true;
    if (written.has_skin)
      add_skin(model, joint);
    else
      for (const glm::dvec3& corner : corners_of(written.part->bounds))
        widen(joint, origins_[joint] + modeler::segment_axes(joints_[joint]) * corner);
  }
}

// A vertex is about where its heaviest bone takes it.
void JointMotions::add_skin(const MeshFile& model, std::size_t joint) {
  const MeshPart& part = *model.joints[joint].part;
  const glm::dmat3 axes = modeler::segment_axes(joints_[joint]);
  for (std::size_t v = 0; v < part.mesh.vertices.size(); ++v) {
    const modeler::VertexBones& bones = part.mesh.bones[v];
    const auto heaviest = std::ranges::max_element(bones.weight) - bones.weight.begin();
    const MeshBone& bone = model.bones[bones.bone[static_cast<std::size_t>(heaviest)]];
    const modeler::Mesh::Place& place = part.mesh.vertices[v];
    const glm::dvec3 in_box =
        part.bounds.min + glm::dvec3(place[0], place[1], place[2]) * (part.bounds.max - part.bounds.min);
    widen(bone.joint, origins_[bone.joint] + bone.bind.turn * (axes * in_box) + bone.bind.place);
  }
}

std::vector<glm::dmat4> JointMotions::moves_at(std::size_t frame) const {
  const std::vector<glm::dmat4> now = nodes_.at(frame);
  std::vector<glm::dmat4> moves;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    const std::size_t node = node_of_[joint], parent = joints_[joint].parent;
    if (node == modeler::kNone) {
      moves.push_back(parent == modeler::kNone ? glm::dmat4(1) : moves[parent]);
      continue;
    }
    const glm::dmat4& before = nodes_at_rest_[node];
    const double flat = kFlat * elementary::pow(distance(glm::dmat3(before), glm::dmat3(0)), 3);
    moves.push_back(std::abs(glm::determinant(glm::dmat3(before))) > flat
                        ? now[node] * glm::inverse(before)
                        : translation(glm::dvec3(now[node][3] - before[3])));
  }
  return moves;
}

modeler::Box JointMotions::box() const {
  std::optional<modeler::Box> box;
  for (std::size_t frame = 0; frame < frames(); ++frame) {
    const std::vector<glm::dmat4> moves = moves_at(frame);
    for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
      if (!carries_[joint]) continue;
      for (const glm::dvec3& corner : corners_of(*carries_[joint])) {
        const glm::dvec3 point = moved(moves[joint], corner);
        box = box ? modeler::Box{glm::min(box->min, point), glm::max(box->max, point)} : modeler::Box{point, point};
      }
    }
  }
  return box.value_or(modeler::Box{});
}

// Of each joint in the film; what is flat goes with its parent.
std::vector<glm::dmat3> JointMotions::turns_of(const std::vector<glm::dmat4>& moves) const {
  std::vector<glm::dmat3> turns;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    const std::size_t parent = joints_[joint].parent;
    const glm::dmat3 otherwise = parent == modeler::kNone ? glm::dmat3(1) : turns[parent];
    turns.push_back(rotation_in(glm::dmat3(moves[joint])).value_or(otherwise));
  }
  return turns;
}

// Of each joint, while the actor's place is 0.
std::vector<glm::dvec3> JointMotions::places_of(const std::vector<glm::dmat3>& turns) const {
  std::vector<glm::dvec3> places;
  for (const modeler::Joint& joint : joints_)
    places.push_back(joint.parent == modeler::kNone ? joint.place
                                                    : places[joint.parent] + turns[joint.parent] * joint.place);
  return places;
}

void JointMotions::add_poses(const std::vector<glm::dmat3>& turns, ActorMotion& motion) const {
  std::vector<glm::dvec3> poses;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    const std::size_t parent = joints_[joint].parent;
    const glm::dmat3 turn = parent == modeler::kNone ? turns[joint] : glm::transpose(turns[parent]) * turns[joint];
    const glm::dvec3 near = motion.poses.empty() ? glm::dvec3(0) : motion.poses.back()[joint];
    poses.push_back(node_of_[joint] == modeler::kNone ? glm::dvec3(0) : animator::pose_of(joints_[joint], turn, near));
  }
  motion.poses.push_back(std::move(poses));
}

// The lowest joint that slides and at or below which all is that is seen; else the first one.
std::size_t JointMotions::placed_joint(const std::vector<bool>& slides) const {
  std::vector<std::size_t> below(joints_.size());  // joints that carry something, at or below each
  for (std::size_t joint = joints_.size(); joint-- > 0;) {
    below[joint] += carries_[joint].has_value();
    if (joints_[joint].parent != modeler::kNone) below[joints_[joint].parent] += below[joint];
  }
  std::size_t placed = 0;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint)
    if (slides[joint] && below[joint] == below[0]) placed = joint;
  return placed;
}

double JointMotions::error_at(const std::vector<glm::dmat4>& moves, const std::vector<glm::dmat3>& turns,
                              const glm::dvec3& place) const {
  const std::vector<glm::dvec3> places = places_of(turns);
  double error = 0;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    if (!carries_[joint]) continue;
    for (const glm::dvec3& corner : corners_of(*carries_[joint]))
      error = std::max(error, glm::length(place + places[joint] + turns[joint] * (corner - origins_[joint]) -
                                          moved(moves[joint], corner)));
  }
  return error;
}

// How far joints go from where their parents take them, and which change their shape.
struct JointMotions::Slides {
  std::vector<double> far;
  std::vector<bool> scaled;

  void add(const JointMotions& of, const std::vector<glm::dmat4>& moves, const std::vector<glm::dmat3>& turns) {
    for (std::size_t joint = 0; joint < of.joints_.size(); ++joint) {
      const std::size_t parent = of.joints_[joint].parent;
      const glm::dvec3 at = moved(moves[joint], of.origins_[joint]);
      const glm::dvec3 taken = parent == modeler::kNone ? of.origins_[joint]
                                                        : moved(moves[parent], of.origins_[parent]) +
                                                              turns[parent] * of.joints_[joint].place;
      far[joint] = std::max(far[joint], glm::length(at - taken));
      if (distance(glm::dmat3(moves[joint]), turns[joint]) > kScaled) scaled[joint] = true;
    }
  }
};

JointMotions::ByKeys JointMotions::by_keys() const {
  ByKeys keys;
  Slides slides{std::vector<double>(joints_.size()), std::vector<bool>(joints_.size())};
  for (std::size_t frame = 0; frame < frames(); ++frame) {
    const std::vector<glm::dmat4> moves = moves_at(frame);
    const std::vector<glm::dmat3> turns = turns_of(moves);
    add_poses(turns, keys.motion);
    slides.add(*this, moves, turns);
  }
  std::vector<bool> sliding;
  for (const double far : slides.far) sliding.push_back(far > kSlides * size_);
  const std::size_t placed = placed_joint(sliding);
  for (std::size_t frame = 0; frame < frames(); ++frame) {
    const std::vector<glm::dmat4> moves = moves_at(frame);
    const std::vector<glm::dmat3> turns = turns_of(moves);
    const glm::dvec3 place = moved(moves[placed], origins_[placed]) - places_of(turns)[placed];
    keys.motion.places.push_back(place);
    keys.error = std::max(keys.error, error_at(moves, turns, place));
  }
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    keys.scaled += slides.scaled[joint];
    if (!sliding[joint] || joint == placed) continue;
    ++keys.sliding;
    keys.farthest = std::max(keys.farthest, slides.far[joint]);
  }
  return keys;
}

glm::dmat4 JointMotions::matrix(std::size_t joint, const glm::dmat4& moves) const {
  return moves * translation(origins_[joint]) * glm::dmat4(modeler::segment_axes(joints_[joint]));
}

}  // namespace mars::importer
