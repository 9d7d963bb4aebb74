#include "host/content/importer/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "hal/failure/failure.h"

namespace mars::importer {
namespace {

constexpr double kLongestNormal = 1e6;

modeler::Mesh::Place unit_normal(const glm::dvec3& normal, const glm::dvec3& extent) {
  const glm::dvec3 n = normal * extent;
  const double length = glm::length(n);
  return length > 0 ? modeler::Mesh::Place{float(n.x / length), float(n.y / length), float(n.z / length)}
                    : modeler::Mesh::Place{};
}

// A face that cannot be drawn as it stands is added in triangles.
void add_drawable(modeler::Mesh& mesh, const std::vector<std::uint32_t>& face) {
  const auto add = [&](std::vector<std::uint32_t> corners) {
    if (!mesh.normals.empty() && modeler::turned_inside(mesh, corners)) std::ranges::reverse(corners);
    mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
    mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  };
  if (face.size() == 3 || (face.size() <= modeler::kMostCorners && modeler::split(mesh, face))) return add(face);
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    if (face[0] != face[k] && face[k] != face[k + 1] && face[0] != face[k + 1]) add({face[0], face[k], face[k + 1]});
}

}  // namespace

std::size_t MeshBuilder::Hash::operator()(const Key& key) const {
  std::size_t sum = 0;
  for (const double number : key) sum = sum * 0x9e3779b97f4a7c15u + std::hash<double>()(number);
  return sum ^ sum >> 29;
}

std::size_t MeshBuilder::part_of(const Material& material) {
  const auto same = [&](const Part& part) { return part.material == material; };
  const auto found = std::find_if(parts_.begin(), parts_.end(), same);
  if (found != parts_.end()) return static_cast<std::size_t>(found - parts_.begin());
  parts_.push_back({material, {}, {}, {}, {}});
  return parts_.size() - 1;
}

MeshBuilder::Vertex MeshBuilder::checked(const glm::dvec3& place, const glm::dvec3& normal) const {
  Vertex vertex{place, style_.takes_normals ? normal : glm::dvec3(0), place, 0};
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(place[axis]))
      throw Failure("has a vertex that is not at numbers, or at too large ones", file_,
                    "the file may be damaged: export it again");
    if (!(std::abs(vertex.normal[axis]) <= kLongestNormal)) vertex.normal = {};
    vertex.place[axis] += 0.0;  // no negative zero
  }
  return vertex;
}

std::uint32_t MeshBuilder::number_of(const modeler::VertexBones& bones) {
  const auto [known, is_new] = follows_numbers_.try_emplace(bones, static_cast<std::uint32_t>(follows_.size()));
  if (is_new) follows_.push_back(bones);
  return known->second;
}

void MeshBuilder::renumber_bones(std::span<const std::uint32_t> numbers) {
  for (modeler::VertexBones& bones : follows_) {
    std::vector<modeler::BoneWeight> renumbered;
    for (std::size_t i = 0; i < modeler::kMostBonesOfVertex; ++i)
      if (bones.weight[i] > 0) renumbered.push_back({numbers[bones.bone[i]], bones.weight[i]});
    bones = *modeler::bones_of_vertex(std::move(renumbered));
  }
  follows_numbers_.clear();
}

std::uint32_t MeshBuilder::vertex(std::size_t number, const glm::dvec3& place, const glm::dvec3& normal,
                                  const Follows* follows) {
  Part& part = parts_[number];
  Vertex vertex = checked(place, normal);
  if (follows != nullptr) {
    vertex.follows = number_of(follows->bones);
    vertex.at_rest = follows->at_rest;
  }
  const glm::dvec3 &p = vertex.place, &n = vertex.normal;
  const auto [at, is_new] = part.numbers.try_emplace({p.x, p.y, p.z, n.x, n.y, n.z, double(vertex.follows)},
                                                     static_cast<std::uint32_t>(part.vertices.size()));
  if (is_new) part.vertices.push_back(vertex);
  return at->second;
}

void MeshBuilder::add_face(std::size_t number, std::vector<std::uint32_t>& face) {
  face.erase(std::unique(face.begin(), face.end()), face.end());
  while (face.size() > 1 && face.front() == face.back()) face.pop_back();
  std::vector<std::uint32_t> different = face;
  std::sort(different.begin(), different.end());
  if (std::unique(different.begin(), different.end()) - different.begin() < 3) {
    ++faces_left_out_;
    return;
  }
  Part& part = parts_[number];
  part.corners.insert(part.corners.end(), face.begin(), face.end());
  part.ends.push_back(static_cast<std::uint32_t>(part.corners.size()));
}

void MeshBuilder::widen(modeler::Box& box, const glm::dvec3& origin, const glm::dmat3& axes) const {
  widen(box, [&](const Vertex& vertex) { return origin + axes * vertex.at_rest; });
}

void MeshBuilder::widen(modeler::Box& box, const auto& place_of) const {
  for (const Part& part : parts_)
    for (const std::uint32_t corner : part.corners) {
      const glm::dvec3 place = place_of(part.vertices[corner]);
      box.min = glm::min(box.min, place);
      box.max = glm::max(box.max, place);
    }
}

modeler::Mesh MeshBuilder::mesh_of(const Part& part, const modeler::Box& bounds, double factor) const {
  modeler::Mesh mesh;
  mesh.crease = style_.crease;
  const glm::dvec3 extent = bounds.max - bounds.min;
  for (const Vertex& vertex : part.vertices) {
    // In doubles the largest may come out of the cube by a rounding.
    const glm::dvec3 unit = glm::clamp((vertex.place * factor - bounds.min) / extent, 0.0, 1.0);
    mesh.vertices.push_back({float(unit.x), float(unit.y), float(unit.z)});
    // Normals shrink where places grow.
    if (style_.takes_normals) mesh.normals.push_back(unit_normal(vertex.normal, extent));
    if (has_skin()) mesh.bones.push_back(follows_[vertex.follows]);
  }
  for (std::size_t face = 0, first = 0; face < part.ends.size(); first = part.ends[face++])
    add_drawable(mesh,
                 std::vector(part.corners.begin() + std::ptrdiff_t(first), part.corners.begin() + part.ends[face]));
  return mesh;
}

std::vector<MeshPart> MeshBuilder::finish(double factor) {
  std::erase_if(parts_, [](const Part& part) { return part.ends.empty(); });
  modeler::Box box = kEmptyBox;
  widen(box, [](const Vertex& vertex) { return vertex.place; });
  const modeler::Box bounds = modeler::thickened({box.min * factor, box.max * factor});
  std::vector<MeshPart> finished;
  for (Part& part : parts_) {
    part.numbers = {};  // its memory is wanted for the mesh
    finished.push_back({part.material, mesh_of(part, bounds, factor), bounds});
  }
  return finished;
}

}  // namespace mars::importer
