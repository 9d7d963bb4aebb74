#include "host/content/importer/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "host/content/document/text.h"

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
void add_drawable(modeler::Mesh& mesh, std::vector<std::uint32_t> face) {
  if (!mesh.normals.empty() && modeler::turned_inside(mesh, face)) std::reverse(face.begin(), face.end());
  const auto add = [&](const auto& corners) {
    mesh.corners.insert(mesh.corners.end(), std::begin(corners), std::end(corners));
    mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  };
  if (face.size() == 3 || (face.size() <= modeler::kMostCorners && modeler::split(mesh, face))) return add(face);
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    if (face[0] != face[k] && face[k] != face[k + 1] && face[0] != face[k + 1])
      add(std::array{face[0], face[k], face[k + 1]});
}

}  // namespace

std::size_t MeshBuilder::Hash::operator()(const std::array<double, 6>& key) const {
  std::size_t sum = 0;
  for (const double number : key) sum = sum * 0x9e3779b97f4a7c15u + std::hash<double>()(number);
  return sum ^ sum >> 29;
}

void MeshBuilder::fail(const std::string& problem, const std::string& remedy) const {
  throw Failure(problem, file_, remedy);
}

std::size_t MeshBuilder::part_of(const Color& color) {
  const auto same = [&](const Part& part) { return part.color == color; };
  const auto found = std::find_if(parts_.begin(), parts_.end(), same);
  if (found != parts_.end()) return static_cast<std::size_t>(found - parts_.begin());
  parts_.push_back({color, {}, {}, {}, {}});
  return parts_.size() - 1;
}

MeshBuilder::Vertex MeshBuilder::placed(const glm::dvec3& place, const glm::dvec3& normal) const {
  Vertex vertex{options_.upright * place * options_.scale, {}};
  if (takes_normals_) vertex.normal = options_.upright * normal;
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(place[axis]))
      fail("has a vertex that is not at numbers, or at too large ones", "the file may be damaged: export it again");
    if (!(std::abs(vertex.place[axis]) <= document::kFarthest))
      fail("has a vertex at " + document::shown(vertex.place[axis]),
           "keep vertices within 1e9 of the origin, with a smaller --scale if need be");
    if (!(std::abs(vertex.normal[axis]) <= kLongestNormal)) vertex.normal = {};
    vertex.place[axis] += 0.0;  // no negative zero
  }
  return vertex;
}

std::uint32_t MeshBuilder::vertex(std::size_t number, const glm::dvec3& place, const glm::dvec3& normal) {
  Part& part = parts_[number];
  const Vertex vertex = placed(place, normal);
  const glm::dvec3 &p = vertex.place, &n = vertex.normal;
  const auto [at, is_new] =
      part.numbers.try_emplace({p.x, p.y, p.z, n.x, n.y, n.z}, static_cast<std::uint32_t>(part.vertices.size()));
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

modeler::Box MeshBuilder::bounds() const {
  modeler::Box box{glm::dvec3(std::numeric_limits<double>::max()), glm::dvec3(std::numeric_limits<double>::lowest())};
  for (const Part& part : parts_)
    for (const std::uint32_t corner : part.corners) {
      box.min = glm::min(box.min, part.vertices[corner].place);
      box.max = glm::max(box.max, part.vertices[corner].place);
    }
  return box;
}

modeler::Mesh MeshBuilder::mesh_of(const Part& part, const modeler::Box& bounds, double crease) const {
  modeler::Mesh mesh;
  mesh.crease = crease;
  const glm::dvec3 extent = bounds.max - bounds.min;
  for (const Vertex& vertex : part.vertices) {
    // In doubles the largest may come out of the cube by a rounding.
    const glm::dvec3 unit = glm::clamp((vertex.place - bounds.min) / extent, 0.0, 1.0);
    mesh.vertices.push_back({float(unit.x), float(unit.y), float(unit.z)});
    // Normals shrink where places grow.
    if (takes_normals_) mesh.normals.push_back(unit_normal(vertex.normal, extent));
  }
  for (std::size_t face = 0, first = 0; face < part.ends.size(); first = part.ends[face++])
    add_drawable(mesh,
                 std::vector(part.corners.begin() + std::ptrdiff_t(first), part.corners.begin() + part.ends[face]));
  return mesh;
}

MeshFile MeshBuilder::finish(double default_crease) {
  std::erase_if(parts_, [](const Part& part) { return part.ends.empty(); });
  if (parts_.empty()) fail("has no faces", "export the object's surface, not only points or lines");
  const modeler::Box box = bounds();
  MeshFile file{{}, modeler::thickened(box), box.max - box.min, 0, {}, {}};
  for (Part& part : parts_) {
    part.numbers = {};  // its memory is wanted for the mesh
    file.parts.push_back({part.color, mesh_of(part, file.bounds, options_.crease.value_or(default_crease))});
  }
  if (faces_left_out_ > 0)
    file.not_read.push_back(document::counted(faces_left_out_, "face", "faces") + " without three different corners");
  if (has_normals_ && !takes_normals_) file.not_read.emplace_back("normals (--crease makes others)");
  return file;
}

}  // namespace mars::importer
