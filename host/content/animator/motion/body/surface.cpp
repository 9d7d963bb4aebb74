#include "host/content/animator/motion/body/surface.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "host/content/modeler/bent_skin.h"

namespace mars::motion {
namespace {

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

using Counts = std::function<bool(std::size_t joint)>;

// Of one segment after another: rigid ones and patches of skins whose joint counts, and meshes of skins.
class SurfaceOf {
 public:
  SurfaceOf(const modeler::Model& model, const std::function<modeler::Axes(std::size_t)>& frame_of, int grid,
            const Counts& counts)
      : model_(model), frame_of_(frame_of), grid_(grid), counts_(counts) {}

  Surface made() {
    for (segment_ = 0; segment_ < model_.joints.size(); ++segment_) {
      if (!joint().segment) continue;
      if (!joint().segment->bones.empty())
        add_skin();
      else if (counts_(segment_))
        add_rigid();
    }
    return std::move(surface_);
  }

 private:
  const modeler::Joint& joint() const { return model_.joints[segment_]; }
  const modeler::Shape& shape() const { return model_.shapes[joint().segment->shape]; }

  void add_rigid() {
    const modeler::Axes frame = modeler::segment_frame(frame_of_(segment_), joint());
    const modeler::Box& box = joint().segment->sbb;
    const auto placed = [&](const glm::dvec3& p) {
      return frame.turn * (box.min + p * (box.max - box.min)) + frame.place;
    };
    for (const wire::Patch& patch : shape().patches) add_patch(patch, segment_, placed);
    if (shape().mesh)
      add_mesh(*shape().mesh, [&](std::size_t vertex) {
        const modeler::Mesh::Place& at = shape().mesh->vertices[vertex];
        return SurfacePoint{placed({at[0], at[1], at[2]}), segment_, segment_};
      });
  }

  void add_skin() {
    const modeler::Segment& segment = *joint().segment;
    if (std::ranges::none_of(segment.bones, counts_, &modeler::Bone::joint)) return;
    std::vector<wire::Matrix> matrices;
    for (const modeler::Bone& bone : segment.bones)
      matrices.push_back(modeler::bone_matrix(frame_of_(bone.joint), bone, joint()));
    const modeler::BentSkin skin(std::move(matrices), segment.blend);
    const auto followed = [&](const modeler::VertexBones& point) {
      return segment.bones[modeler::heaviest_bone(point)].joint;
    };
    if (shape().net) {
      const modeler::ControlNet& net = *shape().net;
      const std::vector<wire::Patch> bent = skin.patches_of(net);
      for (std::size_t number = 0; number < bent.size(); ++number)
        if (const std::size_t by = followed(modeler::followed_by(net, net.patches[number][0])); counts_(by))
          add_patch(bent[number], by, [](const glm::dvec3& place) { return place; });
      return;
    }
    const modeler::Mesh& mesh = *shape().mesh;
    add_mesh(mesh, [&](std::size_t vertex) {
      return SurfacePoint{skin.place_of(mesh.vertices[vertex], mesh.bones[vertex]), followed(mesh.bones[vertex]),
                          segment_};
    });
  }

  template <typename Placed>
  void add_patch(const wire::Patch& patch, std::size_t moved_by, Placed placed) {
    const auto first = static_cast<std::uint32_t>(surface_.points.size()), row = static_cast<std::uint32_t>(grid_);
    for (int i = 0; i < grid_; ++i)
      for (int j = 0; j < grid_; ++j)
        surface_.points.push_back(
            {placed(patch_point(patch, double(i) / (grid_ - 1), double(j) / (grid_ - 1))), moved_by, segment_});
    for (std::uint32_t i = 0; i + 1 < row; ++i)
      for (std::uint32_t j = 0; j + 1 < row; ++j) {
        const std::uint32_t at = first + i * row + j;
        surface_.triangles.push_back({at, at + row, at + row + 1});
        surface_.triangles.push_back({at, at + row + 1, at + 1});
      }
  }

  template <typename PointOf>
  void add_mesh(const modeler::Mesh& mesh, PointOf point_of) {
    const auto first = static_cast<std::uint32_t>(surface_.points.size());
    for (std::size_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) surface_.points.push_back(point_of(vertex));
    for (std::size_t face = 0; face < mesh.ends.size(); ++face) {
      const auto corners = mesh.face(face);
      for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        surface_.triangles.push_back({first + corners[0], first + corners[i], first + corners[i + 1]});
    }
  }

  const modeler::Model& model_;
  const std::function<modeler::Axes(std::size_t)>& frame_of_;
  int grid_;
  const Counts& counts_;
  std::size_t segment_ = 0;
  Surface surface_;
};

// Points that move with joints that count.
Surface surface_in(const modeler::Model& model, const Posture& posture, const Counts& counts) {
  const std::function frame_of = [&](std::size_t joint) { return frame_in(model, posture, joint); };
  Surface surface = SurfaceOf(model, frame_of, kCoarseGrid, counts).made();
  std::erase_if(surface.points, [&](const SurfacePoint& point) { return !counts(point.joint); });
  surface.triangles.clear();
  return surface;
}

}  // namespace

Surface surface_of(const modeler::Model& model, const std::function<modeler::Axes(std::size_t)>& frame_of, int grid) {
  const Counts all = [](std::size_t) { return true; };
  return SurfaceOf(model, frame_of, grid, all).made();
}

std::vector<glm::dvec3> points_of(const modeler::Model& model, const Posture& posture, const Counts& counts) {
  std::vector<glm::dvec3> places;
  for (const SurfacePoint& point : surface_in(model, posture, counts).points) places.push_back(point.place);
  return places;
}

double reach_of_skin(const modeler::Model& model, std::size_t from, const glm::dvec3& direction, const Counts& counts) {
  const Posture drawn = drawn_posture(model);
  const glm::dvec3 origin = frame_in(model, drawn, from).place;
  double most = 0;
  for (const SurfacePoint& point : surface_in(model, drawn, counts).points)
    if (!model.joints[point.segment].segment->bones.empty())
      most = std::max(most, glm::dot(point.place - origin, direction));
  return most;
}

}  // namespace mars::motion
