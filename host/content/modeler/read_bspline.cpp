#include "host/content/modeler/read_bspline.h"

#include <algorithm>
#include <string>

#include "host/content/modeler/bspline.h"
#include "host/content/modeler/read_skin_weights.h"

namespace mars::modeler {
namespace {

PointGrid read_points(const document::Element& element) {
  document::require_kind(element, document::Kind::list);
  if (element.size() == 0) element.refuse("is empty", "write rows of points");
  PointGrid rows;
  rows.reserve(element.size());
  for (const document::Element item : element) {
    document::require_kind(item, document::Kind::list);
    if (!rows.empty() && item.size() != rows[0].size())
      item.refuse("has " + std::to_string(item.size()) + " points, the first row has " + std::to_string(rows[0].size()),
                  "give every row as many points");
    auto& row = rows.emplace_back();
    row.reserve(item.size());
    for (const document::Element point : item) row.push_back(document::read_vector(point, {0, 1}));
  }
  return rows;
}

// Row by row.
std::vector<VertexBones> read_bones(const document::Element& list, const PointGrid& points) {
  document::require_size(list, points.size());
  std::vector<VertexBones> bones;
  for (const document::Element row : list) {
    document::require_size(row, points[0].size());
    for (const document::Element point : row) bones.push_back(read_vertex_bones(point));
  }
  return bones;
}

// How often the knot number `i` stands, knots ascending; where they are periodic, first and last are one.
std::size_t times(const SplineDirection& direction, std::size_t i) {
  const auto count = [&](double knot) {
    const auto [first, last] = std::equal_range(direction.knots.begin(), direction.knots.end(), knot);
    return static_cast<std::size_t>(last - first);
  };
  const double knot = direction.knots[i], front = direction.knots.front(), back = direction.knots.back();
  if (!direction.periodic || (knot != front && knot != back)) return count(knot);
  return count(front) + count(back) - 1;
}

void check_count(const document::Element& element, const SplineDirection& direction, std::size_t points) {
  const auto degree = static_cast<std::size_t>(direction.degree);
  const std::size_t wanted = direction.periodic ? points + 1 : points + degree + 1;
  if (element.size() != wanted)
    element.refuse("has " + std::to_string(element.size()) + " knots for " + std::to_string(points) +
                       " points of degree " + std::to_string(degree),
                   "write " + std::to_string(wanted) + " of them: points + " +
                       (direction.periodic ? "1, where the first comes round again" : "degree + 1"));
}

// That no knot stands so often that the surface tears there, or a point has no part in it.
void check_times(const document::Element& element, const SplineDirection& direction, double from, double to) {
  std::size_t i = 0;
  for (const document::Element item : element) {
    const bool at_end = !direction.periodic && (direction.knots[i] <= from || direction.knots[i] >= to);
    const std::size_t most = static_cast<std::size_t>(direction.degree) + (at_end ? 1 : 0);
    const std::size_t often = times(direction, i++);
    if (often <= most) continue;
    item.refuse("stands " + std::to_string(often) + " times" + (at_end ? "" : ", the surface would tear there"),
                "at degree " + std::to_string(direction.degree) + " write it at most " + std::to_string(most) +
                    " times" + (direction.periodic ? ", the first and the last counting as one" : ""));
  }
}

// Reads them in the form of bspline.h.
std::vector<double> read_knots(const document::Element& element, SplineDirection direction, std::size_t points) {
  document::require_kind(element, document::Kind::list);
  check_count(element, direction, points);
  auto& knots = direction.knots;
  for (const document::Element item : element) {
    knots.push_back(document::read_number(item));
    if (knots.size() > 1 && knots.back() < knots.end()[-2])
      item.refuse("is " + document::shown(knots.back()) + ", less than the knot before it",
                  "write knots that never descend");
  }
  const std::size_t first = direction.periodic ? 0 : static_cast<std::size_t>(direction.degree);
  if (!(knots[first] < knots[points]))
    element.refuse("has the same knot at [" + std::to_string(first) + "] and [" + std::to_string(points) +
                       "], and the surface lies between these",
                   "give these two different values");
  check_times(element, direction, knots[first], knots[points]);
  return knots;
}

// The direction `key` of the surface, which has `points` points along it.
SplineDirection read_direction(const document::Fields& surface, std::string_view key, std::size_t points) {
  const document::Fields fields(surface.value(key), keys::object("direction"));
  const std::uint32_t degree = fields.count("degree");
  const Ends ends = static_cast<Ends>(fields.choice("ends"));
  const auto knots = fields.find("knots");
  if (const auto given = fields.find("ends"); given && knots && ends != Ends::periodic)
    given->refuse("stands beside knots, which say themselves how the surface ends", "take out ends, or the knots");
  if (points <= degree)
    surface.required("points").refuse("has " + std::to_string(points) + " points along " + std::string(key) +
                                          ", degree " + std::to_string(degree) + " needs at least " +
                                          std::to_string(degree + 1),
                                      "add points, or lower the degree of " + std::string(key));
  if (!knots) return uniform_direction(ends, static_cast<int>(degree), points);
  SplineDirection direction{static_cast<int>(degree), ends == Ends::periodic, {}};
  direction.knots = read_knots(*knots, direction, points);
  return direction;
}

}  // namespace

PatchShape read_bspline(const document::Element& element) {
  const document::Fields fields(element, keys::object("bspline"));
  const PointGrid points = read_points(fields.required("points"));
  const SplineDirection u = read_direction(fields, "u", points[0].size());
  const SplineDirection v = read_direction(fields, "v", points.size());
  PatchShape shape{rounded(bezier_patches(points, u, v))};
  if (const auto bones = fields.find("bones")) {
    const std::size_t columns = points[0].size();
    std::vector<glm::dvec3> all;
    for (const auto& row : points) all.insert(all.end(), row.begin(), row.end());
    shape.net = control_net(bezier_means(columns, points.size(), u, v), all, read_bones(*bones, points), columns);
  }
  return shape;
}

}  // namespace mars::modeler
