#include "host/content/modeler/meshlets.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>

#include "hal/failure/failure.h"
#include "host/content/modeler/mesh_normals.h"

namespace mars::modeler {
namespace {

using Corners = std::array<std::uint32_t, 3>;  // numbers of shaded vertices

std::vector<Corners> triangles_of(const Mesh& mesh, const ShadedVertices& shaded) {
  std::vector<Corners> triangles;
  triangles.reserve(mesh.corners.size() - 2 * mesh.ends.size());
  for (std::size_t face = 0; face < mesh.ends.size(); ++face) {
    const std::size_t first = mesh.first_corner(face);
    const auto parts = split(mesh, mesh.face(face));
    check(parts.has_value(), "a mesh's faces were checked when it was read");
    for (const Mesh::Triangle& t : *parts)
      triangles.push_back(
          {shaded.of_corners[first + t[0]], shaded.of_corners[first + t[1]], shaded.of_corners[first + t[2]]});
  }
  return triangles;
}

// A place on a curve that fills the cube, so that what is near on it is near in space (Morton 1966).
std::uint32_t along_curve(const ShadedVertices& shaded, const Corners& triangle) {
  std::uint32_t code = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float sum = 0;
    for (const std::uint32_t corner : triangle) sum += shaded.places[corner][axis];
    const auto cell = static_cast<std::uint32_t>(std::clamp(sum / 3, 0.0f, 1.0f) * 1023);
    for (std::uint32_t bit = 0; bit < 10; ++bit) code |= (cell >> bit & 1) << (3 * bit + axis);
  }
  return code;
}

void sort_along_curve(const ShadedVertices& shaded, std::vector<Corners>& triangles) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order;
  order.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) order.emplace_back(along_curve(shaded, triangles[i]), i);
  std::sort(order.begin(), order.end());
  std::vector<Corners> sorted;
  sorted.reserve(triangles.size());
  for (const auto& [code, i] : order) sorted.push_back(triangles[i]);
  triangles = std::move(sorted);
}

class Cutter {
 public:
  explicit Cutter(const ShadedVertices& shaded) : shaded_(shaded), seen_(shaded.places.size()) {}

  void add(const Corners& triangle) {
    const auto fresh = static_cast<std::uint32_t>(std::count_if(
        triangle.begin(), triangle.end(), [&](std::uint32_t vertex) { return seen_[vertex].meshlet != number_; }));
    if (number_ == 0 || now().triangle_count == wire::kMeshletTriangles ||
        now().vertex_count + fresh > wire::kMeshletVertices ||
        (has_skin() && bones_with(triangle).size() > wire::kMeshletBones)) {
      end();
      begin();
    }
    if (has_skin()) bones_ = bones_with(triangle);
    wire::MeshTriangle corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = local(triangle[k]);
    out_.triangles.push_back(corners);
    ++now().triangle_count;
  }

  Meshlets take() {
    end();
    return std::move(out_);
  }

 private:
  struct Seen {
    std::uint32_t meshlet = 0;  // the last to have it, from 1
    std::uint8_t local = 0;
  };

  wire::Meshlet& now() { return out_.meshlets.back(); }
  bool has_skin() const { return !shaded_.bones.empty(); }

  // Bones of the meshlet's vertices with those of the triangle, ascending.
  std::vector<std::uint32_t> bones_with(const Corners& triangle) const {
    std::vector<std::uint32_t> bones;
    std::ranges::set_union(
        bones_,
        all_bones(std::array{shaded_.bones[triangle[0]], shaded_.bones[triangle[1]], shaded_.bones[triangle[2]]}),
        std::back_inserter(bones));
    return bones;
  }

  void end() {
    if (!has_skin() || number_ == 0) return;
    now().skin = out_.skins.add(points_);
    bones_.clear();
    points_.clear();
  }

  void begin() {
    out_.meshlets.push_back({static_cast<std::uint32_t>(out_.places.size()),
                             0,
                             static_cast<std::uint32_t>(out_.triangles.size()),
                             0,
                             {2, 2, 2},
                             {-1, -1, -1}});
    ++number_;
  }

  std::uint8_t local(std::uint32_t vertex) {
    Seen& seen = seen_[vertex];
    if (seen.meshlet == number_) return seen.local;
    seen = {number_, static_cast<std::uint8_t>(now().vertex_count++)};
    const auto& place = shaded_.places[vertex];
    out_.places.push_back(place);
    out_.normals.push_back(shaded_.normals[vertex]);
    if (has_skin()) points_.push_back(shaded_.bones[vertex]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      now().low[axis] = std::min(now().low[axis], place[axis]);
      now().high[axis] = std::max(now().high[axis], place[axis]);
    }
    return seen.local;
  }

  const ShadedVertices& shaded_;
  std::vector<Seen> seen_;
  std::vector<std::uint32_t> bones_;  // of a skin, in the meshlet that grows
  std::vector<VertexBones> points_;   // the same of each vertex
  Meshlets out_;
  std::uint32_t number_ = 0;
};

}  // namespace

Meshlets cut_meshlets(const Mesh& mesh) {
  const ShadedVertices shaded = shaded_vertices(mesh);
  std::vector<Corners> triangles = triangles_of(mesh, shaded);
  sort_along_curve(shaded, triangles);
  Cutter cutter(shaded);
  for (const Corners& triangle : triangles) cutter.add(triangle);
  return cutter.take();
}

}  // namespace mars::modeler
