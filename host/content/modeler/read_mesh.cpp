#include "host/content/modeler/read_mesh.h"

#include <algorithm>
#include <string>

#include "host/content/modeler/check_paint.h"
#include "host/content/modeler/read_skin_weights.h"

namespace mars::modeler {
namespace {

std::vector<Mesh::Place> read_places(const document::Element& list, document::Range range) {
  document::require_kind(list, document::Kind::list);
  std::vector<Mesh::Place> places;
  places.reserve(list.size());
  for (const document::Element item : list) {
    const glm::dvec3 v = document::read_vector(item, range);
    places.push_back({float(v.x), float(v.y), float(v.z)});
  }
  return places;
}

void check_face(const document::Element& element, const Mesh& mesh, std::span<const std::uint32_t> face) {
  for (std::size_t i = 0; i < face.size(); ++i)
    if (face[i] == face[(i + 1) % face.size()])
      element.refuse("names vertex " + std::to_string(face[i]) + " twice in a row", "name it once");
  std::vector<std::uint32_t> different(face.begin(), face.end());
  std::sort(different.begin(), different.end());
  if (std::unique(different.begin(), different.end()) - different.begin() < 3)
    element.refuse("has fewer than 3 different vertices", "give each face at least 3, or take it out");
  if (!split(mesh, face))
    element.refuse("crosses itself", "name its vertices in the order of its outline, or split it into triangles");
}

void read_faces(const document::Element& list, Mesh& mesh) {
  document::require_kind(list, document::Kind::list);
  if (list.size() == 0) list.refuse("has no faces", "give at least one");
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (const document::Element item : list) {
    document::require_kind(item, document::Kind::list);
    if (item.size() < 3 || item.size() > kMostCorners)
      item.refuse("has " + std::to_string(item.size()) + " vertices", "write 3 to 4096 numbers of vertices");
    for (const document::Element corner : item) mesh.corners.push_back(document::read_count(corner, 0, last));
    mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    check_face(item, mesh, mesh.face(mesh.ends.size() - 1));
  }
}

void read_normals(const document::Element& list, const document::Element& faces, Mesh& mesh) {
  document::require_size(list, mesh.vertices.size());
  mesh.normals = read_places(list, {-1e6, 1e6});
  std::size_t number = 0;
  for (const document::Element face : faces)
    if (turned_inside(mesh, mesh.face(number++)))
      face.refuse("has normals that point to its inside",
                  "name its vertices counter-clockwise as seen from outside, or turn the normals");
}

void read_bones(const document::Element& list, Mesh& mesh) {
  document::require_size(list, mesh.vertices.size());
  for (const document::Element vertex : list) mesh.bones.push_back(read_vertex_bones(vertex));
}

}  // namespace

Mesh read_mesh(const document::Element& element) {
  const document::Fields fields(element, keys::object("mesh"));
  Mesh mesh;
  const document::Element vertices = fields.required("vertices");
  mesh.vertices = read_places(vertices, {0, 1});
  if (mesh.vertices.size() < 3) vertices.refuse("has fewer than 3 vertices", "give at least 3");
  const document::Element faces = fields.required("faces");
  read_faces(faces, mesh);
  mesh.crease = fields.number("crease");
  if (const auto normals = fields.find("normals")) {
    if (fields.find("crease")) normals->refuse("stands beside a crease", "take one of the two out");
    read_normals(*normals, faces, mesh);
  }
  if (const auto bones = fields.find("bones")) read_bones(*bones, mesh);
  check_paint(fields, mesh);
  return mesh;
}

}  // namespace mars::modeler
