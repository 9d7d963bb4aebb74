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

// Adds faces to a part, whose mesh has its vertices.
class FaceAdder {
 public:
  explicit FaceAdder(MeshPart& part) : part_(part), mesh_(part.mesh) {}

  // By the numbers of vertices, and of rows or none. A face that cannot be drawn as it stands is added in triangles.
  void add(std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> rows) {
    if (vertices.size() == 3 || (vertices.size() <= modeler::kMostCorners && modeler::split(mesh_, vertices)))
      return add_whole(vertices, rows);
    for (std::size_t k = 1; k + 1 < vertices.size(); ++k) {
      const std::array<std::uint32_t, 3> triangle{vertices[0], vertices[k], vertices[k + 1]};
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[0] == triangle[2]) continue;
      if (rows.empty())
        add_whole(triangle, {});
      else
        add_whole(triangle, std::array<std::uint32_t, 3>{rows[0], rows[k], rows[k + 1]});
    }
  }

 private:
  void add_whole(std::span<const std::uint32_t> vertices, std::span<const std::uint32_t> rows) {
    const bool inside = !mesh_.normals.empty() && modeler::turned_inside(mesh_, vertices);
    append(mesh_.corners, vertices, inside);
    append(part_.paint.corners, rows, inside);
    mesh_.ends.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
  }

  static void append(std::vector<std::uint32_t>& list, std::span<const std::uint32_t> more, bool backwards) {
    if (backwards)
      list.insert(list.end(), more.rbegin(), more.rend());
    else
      list.insert(list.end(), more.begin(), more.end());
  }

  MeshPart& part_;
  modeler::Mesh& mesh_;
};

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
  parts_.push_back({material, {}, {}, {}, {}, {}});
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

std::uint32_t MeshBuilder::vertex(Part& part, const glm::dvec3& place, const glm::dvec3& normal,
                                  const Follows* follows) {
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

std::uint32_t MeshBuilder::add_row(Part& part, const Row& row) {
  part.vertices[row.vertex].row = static_cast<std::uint32_t>(part.rows.size());
  part.rows.push_back(row);
  return part.vertices[row.vertex].row;
}

// Rows of a vertex that has very many of them are not compared with all: a row too many costs its bytes only.
std::uint32_t MeshBuilder::row_of(Part& part, std::uint32_t vertex, const CornerPaint& paint) {
  constexpr int kMostCompared = 64;
  Row row{vertex, part.vertices[vertex].row};
  row.uv = paint.uv.value_or(row.uv);
  row.color = paint.color.value_or(row.color);
  std::uint32_t known = row.older;
  for (int compared = 0; known != kNoRow && compared < kMostCompared; ++compared, known = part.rows[known].older)
    if (part.rows[known].uv == row.uv && part.rows[known].color == row.color) return known;
  return add_row(part, row);
}

std::uint32_t MeshBuilder::corner(std::size_t number, const glm::dvec3& place, const glm::dvec3& normal,
                                  const Follows* follows, const CornerPaint& paint) {
  Part& part = parts_[number];
  // Corners that were numbers of vertices are numbers of rows from now on.
  if ((paint.uv || paint.color) && part.rows.empty())
    for (std::uint32_t each = 0; each < part.vertices.size(); ++each) add_row(part, {each, kNoRow});
  const std::uint32_t vertex = this->vertex(part, place, normal, follows);
  part.has_uv = part.has_uv || paint.uv;
  part.has_colors = part.has_colors || paint.color;
  return part.has_uv || part.has_colors ? row_of(part, vertex, paint) : vertex;
}

void MeshBuilder::add_face(std::size_t number, std::vector<std::uint32_t>& face) {
  Part& part = parts_[number];
  const auto at_one = [&](std::uint32_t a, std::uint32_t b) { return part.vertex_of(a) == part.vertex_of(b); };
  face.erase(std::unique(face.begin(), face.end(), at_one), face.end());
  while (face.size() > 1 && at_one(face.front(), face.back())) face.pop_back();
  std::vector<std::uint32_t> different;
  for (const std::uint32_t corner : face) different.push_back(part.vertex_of(corner));
  std::sort(different.begin(), different.end());
  if (std::unique(different.begin(), different.end()) - different.begin() < 3) {
    ++faces_left_out_;
    return;
  }
  part.corners.insert(part.corners.end(), face.begin(), face.end());
  part.ends.push_back(static_cast<std::uint32_t>(part.corners.size()));
}

void MeshBuilder::widen(modeler::Box& box, const glm::dvec3& origin, const glm::dmat3& axes) const {
  widen(box, [&](const Vertex& vertex) { return origin + axes * vertex.at_rest; });
}

void MeshBuilder::widen(modeler::Box& box, const auto& place_of) const {
  for (const Part& part : parts_)
    for (const std::uint32_t corner : part.corners) {
      const glm::dvec3 place = place_of(part.vertices[part.vertex_of(corner)]);
      box.min = glm::min(box.min, place);
      box.max = glm::max(box.max, place);
    }
}

modeler::Mesh MeshBuilder::vertices_of(const Part& part, const modeler::Box& bounds, double factor) const {
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
  return mesh;
}

MeshPart MeshBuilder::finished(const Part& part, const modeler::Box& bounds, double factor) const {
  MeshPart made{part.material, vertices_of(part, bounds, factor), bounds, {}};
  for (const Row& row : part.rows) {
    if (part.has_uv) made.paint.uv.push_back(row.uv);
    if (part.has_colors) made.paint.colors.push_back(row.color);
  }
  const bool one_each = part.rows.size() <= part.vertices.size() &&
                        std::ranges::all_of(part.rows, [&](const Row& row) { return &row == &part.rows[row.vertex]; });
  FaceAdder faces(made);
  std::vector<std::uint32_t> vertices;
  for (std::size_t face = 0, first = 0; face < part.ends.size(); first = part.ends[face++]) {
    const std::span corners = std::span(part.corners).subspan(first, part.ends[face] - first);
    vertices.clear();
    for (const std::uint32_t corner : corners) vertices.push_back(part.vertex_of(corner));
    faces.add(vertices, one_each ? std::span<const std::uint32_t>() : corners);
  }
  return made;
}

std::vector<MeshPart> MeshBuilder::finish(double factor) {
  std::erase_if(parts_, [](const Part& part) { return part.ends.empty(); });
  modeler::Box box = kEmptyBox;
  widen(box, [](const Vertex& vertex) { return vertex.place; });
  const modeler::Box bounds = modeler::thickened({box.min * factor, box.max * factor});
  std::vector<MeshPart> made;
  for (Part& part : parts_) {
    part.numbers = {};  // its memory is wanted for the mesh
    made.push_back(finished(part, bounds, factor));
    part = {};
  }
  return made;
}

}  // namespace mars::importer
