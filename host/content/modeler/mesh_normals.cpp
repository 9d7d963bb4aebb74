#include "host/content/modeler/mesh_normals.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "host/content/elementary/elementary.h"

namespace mars::modeler {
namespace {

constexpr double kRounding = 1e-9;  // of a cosine

glm::dvec3 vector_of(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

glm::dvec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

// Two corners of one face between which an edge runs, from the first to the second.
struct Edge {
  std::uint32_t places[2];  // the lesser first
  std::uint32_t from;
  std::uint32_t to;
  std::uint32_t face;

  auto key() const { return std::pair(places[0], places[1]); }
};

class Smoother {
 public:
  explicit Smoother(const Mesh& mesh) : mesh_(mesh), groups_(mesh.corners.size()) {
    std::iota(groups_.begin(), groups_.end(), 0u);
    number_places();
    for (std::size_t face = 0; face < mesh.ends.size(); ++face) {
      const auto area = area_vector(mesh, mesh.face(face));
      face_normals_.push_back(unit({area[0], area[1], area[2]}));
    }
    join_over_edges();
  }

  // A vertex a group, in the order of their first corners.
  ShadedVertices vertices() {
    ShadedVertices out;
    std::vector<glm::dvec3> sums;
    out.of_corners.resize(groups_.size());
    for (std::size_t face = 0; face < mesh_.ends.size(); ++face)
      for (auto corner = static_cast<std::uint32_t>(mesh_.first_corner(face)); corner < mesh_.ends[face]; ++corner) {
        const std::uint32_t group = find(corner);  // its lowest corner
        if (group == corner) {
          out.of_corners[corner] = static_cast<std::uint32_t>(sums.size());
          sums.emplace_back(0);
          out.places.push_back(mesh_.vertices[mesh_.corners[corner]]);
          if (!mesh_.bones.empty()) out.bones.push_back(mesh_.bones[mesh_.corners[corner]]);
        }
        out.of_corners[corner] = out.of_corners[group];
        sums[out.of_corners[corner]] += angle(face, corner) * face_normals_[face];
      }
    for (const glm::dvec3& sum : sums) {
      const glm::dvec3 normal = unit(sum);
      out.normals.push_back({float(normal.x), float(normal.y), float(normal.z)});
    }
    return out;
  }

 private:
  // Vertices at the same place, that follow the same bones, get the same number.
  void number_places() {
    const auto& vertices = mesh_.vertices;
    const auto compare = [&](std::uint32_t a, std::uint32_t b) {
      const auto places = vertices[a] <=> vertices[b];
      return places != 0 || mesh_.bones.empty() ? places : mesh_.bones[a] <=> mesh_.bones[b];
    };
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return compare(a, b) < 0; });
    places_.resize(vertices.size());
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i > 0 && compare(order[i], order[i - 1]) != 0) ++number;
      places_[order[i]] = number;
    }
  }

  std::vector<Edge> sorted_edges() const {
    std::vector<Edge> edges;
    edges.reserve(mesh_.corners.size());
    for (std::size_t face = 0; face < mesh_.ends.size(); ++face) {
      const auto first = static_cast<std::uint32_t>(mesh_.first_corner(face)), end = mesh_.ends[face];
      for (std::uint32_t from = first; from < end; ++from) {
        const std::uint32_t to = from + 1 < end ? from + 1 : first;
        const auto [low, high] = std::minmax({places_[mesh_.corners[from]], places_[mesh_.corners[to]]});
        edges.push_back({{low, high}, from, to, static_cast<std::uint32_t>(face)});
      }
    }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) { return std::pair(a.key(), a.from) < std::pair(b.key(), b.from); });
    return edges;
  }

  // An edge of more or fewer than two faces, or that both run the same way, stays sharp.
  void join_over_edges() {
    const std::vector<Edge> edges = sorted_edges();
    const double least = elementary::cos(mesh_.crease * std::numbers::pi / 180) - kRounding;
    for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
      while (end < edges.size() && edges[end].key() == edges[first].key()) ++end;
      if (end - first != 2) continue;
      const Edge &one = edges[first], &other = edges[first + 1];
      const bool opposite = place_of(one.from) == place_of(other.to) && place_of(one.from) != place_of(one.to);
      if (!opposite || !smooth(one.face, other.face, least)) continue;
      join(one.from, other.to);
      join(one.to, other.from);
    }
  }

  // A face without area has no angle to others: it passes on theirs.
  bool smooth(std::uint32_t one, std::uint32_t other, double least) const {
    const glm::dvec3 &a = face_normals_[one], &b = face_normals_[other];
    return a == glm::dvec3(0) || b == glm::dvec3(0) || glm::dot(a, b) >= least;
  }

  std::uint32_t place_of(std::uint32_t corner) const { return places_[mesh_.corners[corner]]; }

  // Of the face at this corner, 0 to 2 pi.
  double angle(std::size_t face, std::uint32_t corner) const {
    const auto first = static_cast<std::uint32_t>(mesh_.first_corner(face)), end = mesh_.ends[face];
    const auto place = [&](std::uint32_t c) { return vector_of(mesh_.vertices[mesh_.corners[c]]); };
    const glm::dvec3 here = place(corner), to = place(corner + 1 < end ? corner + 1 : first) - here,
                     from = place(corner > first ? corner - 1 : end - 1) - here;
    const glm::dvec3 across = glm::cross(to, from);
    const double angle = elementary::atan2(glm::length(across), glm::dot(to, from));
    return glm::dot(across, face_normals_[face]) < 0 ? 2 * std::numbers::pi - angle : angle;
  }

  std::uint32_t find(std::uint32_t corner) {
    while (groups_[corner] != corner) corner = groups_[corner] = groups_[groups_[corner]];
    return corner;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    groups_[high] = low;
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> groups_;  // of corners: one of its group with a lower number, or itself
  std::vector<std::uint32_t> places_;  // of vertices
  std::vector<glm::dvec3> face_normals_;
};

}  // namespace

ShadedVertices shaded_vertices(const Mesh& mesh) {
  if (!mesh.normals.empty()) return {mesh.vertices, mesh.normals, mesh.corners, mesh.bones};
  return Smoother(mesh).vertices();
}

}  // namespace mars::modeler
