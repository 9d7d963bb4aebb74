#include "host/content/modeler/mesh.h"

#include <algorithm>
#include <cmath>

namespace mars::modeler {
namespace {

struct Point {
  double x, y;
};

// Twice the area of a, b, c: positive where they run counter-clockwise.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

struct Areas {
  std::array<double, 3> sum{};  // of the vectors of a fan's triangles, twice their areas long
  double apart = 0;             // of their lengths
};

Areas areas_of(const Mesh& mesh, std::span<const std::uint32_t> face) {
  Areas areas;
  const Mesh::Place& origin = mesh.vertices[face[0]];
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    double a[3], b[3], square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      a[axis] = double{mesh.vertices[face[i]][axis]} - origin[axis];
      b[axis] = double{mesh.vertices[face[i + 1]][axis]} - origin[axis];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
      const double part = a[next] * b[last] - a[last] * b[next];
      areas.sum[axis] += part;
      square += part * part;
    }
    areas.apart += std::sqrt(square);
  }
  return areas;
}

// Whether what the outline goes round one way it goes round the other way too, as a bow tie does.
bool cancels(const Areas& areas) {
  double square = 0;
  for (const double part : areas.sum) square += part * part;
  return std::sqrt(square) < 1e-9 * areas.apart;
}

// The face as seen from where its normal points, along the axis that the normal is nearest to.
std::vector<Point> flattened(const Mesh& mesh, std::span<const std::uint32_t> face) {
  const auto normal = area_vector(mesh, face);
  std::size_t axis = 0;
  for (std::size_t other = 1; other < 3; ++other)
    if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
  std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(x, y);
  std::vector<Point> points;
  points.reserve(face.size());
  for (const std::uint32_t number : face) points.push_back({mesh.vertices[number][x], mesh.vertices[number][y]});
  return points;
}

// Cuts ears off a polygon until a triangle is left (Meisters 1975). An ear is a corner that turns left and whose
// triangle holds no corner that turns right; cutting one off changes only what its two neighbours are.
class EarClipper {
 public:
  explicit EarClipper(std::vector<Point> points) : points_(std::move(points)), links_(points_.size()) {
    const auto count = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 0; i < count; ++i) links_[i] = {(i + count - 1) % count, (i + 1) % count, false};
    for (std::uint32_t i = 0; i < count; ++i)
      if (corner_turn(i) < 0) hollows_.push_back(i);
    for (std::uint32_t i = 0; i < count; ++i) links_[i].ear = is_ear(i);
  }

  std::optional<std::vector<Mesh::Triangle>> run() {
    std::vector<Mesh::Triangle> triangles;
    std::uint32_t at = 0, left = static_cast<std::uint32_t>(points_.size()), passed = 0;
    while (left > 3) {
      const auto [before, after, ear] = links_[at];
      if (!ear) {
        if (++passed > left) return std::nullopt;
        at = after;
        continue;
      }
      triangles.push_back({before, at, after});
      links_[before].after = after;
      links_[after].before = before;
      std::erase(hollows_, at);
      for (const std::uint32_t neighbour : {before, after}) {
        if (corner_turn(neighbour) >= 0) std::erase(hollows_, neighbour);
        links_[neighbour].ear = is_ear(neighbour);
      }
      at = links_[after].after;  // the next but one: slivers to a single corner are rarer so
      passed = 0;
      --left;
    }
    if (corner_turn(at) < 0) return std::nullopt;
    triangles.push_back({links_[at].before, at, links_[at].after});
    return triangles;
  }

 private:
  struct Link {
    std::uint32_t before;
    std::uint32_t after;
    bool ear;
  };

  double corner_turn(std::uint32_t i) const {
    return turn(points_[links_[i].before], points_[i], points_[links_[i].after]);
  }

  bool is_ear(std::uint32_t i) const {
    if (corner_turn(i) < 0) return false;
    const Point &a = points_[links_[i].before], &b = points_[i], &c = points_[links_[i].after];
    return std::none_of(hollows_.begin(), hollows_.end(), [&](std::uint32_t hollow) {
      const Point& p = points_[hollow];
      const auto same = [&](const Point& q) { return p.x == q.x && p.y == q.y; };
      if (hollow == i || same(a) || same(b) || same(c)) return false;
      return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
  }

  std::vector<Point> points_;
  std::vector<Link> links_;
  std::vector<std::uint32_t> hollows_;  // corners that turn right
};

}  // namespace

std::array<double, 3> area_vector(const Mesh& mesh, std::span<const std::uint32_t> face) {
  return areas_of(mesh, face).sum;
}

bool turned_inside(const Mesh& mesh, std::span<const std::uint32_t> face) {
  const auto area = area_vector(mesh, face);
  double sum = 0;
  for (const std::uint32_t number : face)
    for (std::size_t axis = 0; axis < 3; ++axis) sum += area[axis] * mesh.normals[number][axis];
  return sum < 0;
}

std::optional<std::vector<Mesh::Triangle>> split(const Mesh& mesh, std::span<const std::uint32_t> face) {
  if (face.size() == 3) return std::vector<Mesh::Triangle>{{0, 1, 2}};
  if (cancels(areas_of(mesh, face))) return std::nullopt;
  return EarClipper(flattened(mesh, face)).run();
}

}  // namespace mars::modeler
