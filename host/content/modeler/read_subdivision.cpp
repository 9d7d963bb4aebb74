#include "host/content/modeler/read_subdivision.h"

#include <algorithm>
#include <string>
#include <utility>

#include "host/content/modeler/read_skin_weights.h"
#include "host/content/modeler/subdivision.h"

namespace mars::modeler {
namespace {

std::vector<glm::dvec3> read_cage_points(const document::Element& list) {
  document::require_kind(list, document::Kind::list);
  if (list.size() < 3) list.refuse("has fewer than 3 points", "give at least 3");
  std::vector<glm::dvec3> points;
  for (const document::Element point : list) points.push_back(document::read_vector(point, {0, 1}));
  return points;
}

std::vector<std::uint32_t> read_face(const document::Element& element, std::uint32_t last) {
  document::require_kind(element, document::Kind::list);
  if (element.size() < 3 || element.size() > kMostAround)
    element.refuse("has " + std::to_string(element.size()) + " points",
                   "write 3 to " + std::to_string(kMostAround) + " numbers of points, or divide the face");
  std::vector<std::uint32_t> face;
  for (const document::Element corner : element) {
    face.push_back(document::read_count(corner, 0, last));
    if (std::ranges::count(face, face.back()) > 1)
      element.refuse("names point " + std::to_string(face.back()) + " twice", "name it once");
  }
  return face;
}

void check_cage(const Cage& cage, const document::Element& points, const document::Element& faces) {
  const auto fault = fault_of(cage);
  if (!fault) return;
  std::size_t number = 0;
  for (const document::Element item : fault->face ? faces : points)
    if (number++ == fault->face.value_or(fault->point)) item.refuse(fault->problem, fault->remedy);
}

int read_level(const document::Fields& fields, const Cage& cage) {
  const auto level = static_cast<int>(fields.count("level"));
  std::size_t patches = 0;
  for (const auto& face : cage.faces) patches += level == 0 ? 1 : face.size() << 2 * (level - 1);
  if (patches > kMostCagePatches)
    fields.value("level").refuse("makes " + std::to_string(patches) + " patches", "take a lower level");
  if (level == 0 && !std::ranges::all_of(cage.faces, [](const auto& face) { return face.size() == 4; }))
    fields.value("level").refuse("is 0, but a face is no quad", "take level 1, which makes quads of all faces");
  return level;
}

// Of a skin, as many as nodes take.
void check_terms(const ControlNet& net, const document::Element& faces) {
  const auto most = std::ranges::max_element(net.stencils, {}, &wire::Stencil::term_count);
  if (most->term_count > wire::kMostTerms)
    faces.refuse("make places of the surface that are means of " + std::to_string(most->term_count) + " points",
                 "let faces with fewer corners, and fewer of them, meet in a point: a skin's places are means of " +
                     std::to_string(wire::kMostTerms) + " points at most");
}

}  // namespace

PatchShape read_subdivision(const document::Element& element) {
  const document::Fields fields(element, keys::object("subdivision"));
  const document::Element list = fields.required("points"), faces = fields.required("faces");
  const std::vector<glm::dvec3> points = read_cage_points(list);
  Cage cage{points.size(), {}};
  document::require_kind(faces, document::Kind::list);
  if (faces.size() == 0) faces.refuse("has no faces", "give at least one");
  for (const document::Element face : faces)
    cage.faces.push_back(read_face(face, static_cast<std::uint32_t>(points.size() - 1)));
  check_cage(cage, list, faces);
  const MeanPatches means = subdivided(cage, read_level(fields, cage));
  PatchShape shape{patches_of(means, points)};
  if (const auto bones = fields.find("bones")) {
    document::require_size(*bones, points.size());
    std::vector<VertexBones> follows;
    for (const document::Element point : *bones) follows.push_back(read_vertex_bones(point));
    shape.net = control_net(means, points, std::move(follows), points.size());
    check_terms(*shape.net, faces);
  }
  return shape;
}

}  // namespace mars::modeler
