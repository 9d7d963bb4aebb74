#include "host/content/modeler/bspline.h"

#include <algorithm>
#include <span>
#include <utility>

namespace mars::modeler {
namespace {

// Exact where a and b are equal, and at parts 0 and 1; the same from either side.
glm::dvec3 between(const glm::dvec3& a, const glm::dvec3& b, double part) {
  return part < 0.5 ? a + part * (b - a) : b - (1 - part) * (b - a);
}

Mean between(const Mean& a, const Mean& b, double part) {
  return sum_of(std::array{Share{a, 1 - part}, Share{b, part}});
}

// Control points and knots of one row or column, numbered on past both ends where it is periodic.
template <typename Point>
class Spline {
 public:
  Spline(const SplineDirection& direction, std::span<const Point> points)
      : direction_(direction), points_(points), count_(static_cast<int>(points.size())) {}

  // Three cubic Bezier points for each span, and the last one's end unless it is the first one's beginning.
  std::vector<Point> bezier_points() const {
    const int first = direction_.periodic ? 0 : direction_.degree;
    std::vector<Point> bezier;
    int last = first;
    for (int span = first; span < count_; ++span) {
      if (!(knot(span) < knot(span + 1))) continue;
      add_span(bezier, span);
      last = span;
    }
    if (!direction_.periodic) bezier.push_back(blossom(last, direction_.degree));
    return bezier;
  }

 private:
  double knot(int i) const {
    const auto& knots = direction_.knots;
    const auto at = [&](int k) { return knots[static_cast<std::size_t>(k)]; };
    if (!direction_.periodic) return at(i);
    if (i < 0) return at(0) - (at(count_) - at(i + count_));
    return i > count_ ? at(count_) + (at(i - count_) - at(0)) : at(i);
  }

  const Point& point(int i) const { return points_[static_cast<std::size_t>((i + count_) % count_)]; }

  // The Bezier point number `ends`, 0..degree, of the span from knot `span` on: the polar form at that many
  // times the span's end, and its beginning for the rest.
  Point blossom(int span, int ends) const {
    const int degree = direction_.degree;
    std::array<Point, kMostDegree + 1> means;
    for (int k = 0; k <= degree; ++k) means[static_cast<std::size_t>(k)] = point(span - degree + k);
    for (int level = 1; level <= degree; ++level) {
      const double at = knot(level <= ends ? span + 1 : span);
      for (int k = degree; k >= level; --k) {
        const int i = span - degree + k;
        const double low = knot(i), high = knot(i + degree + 1 - level);
        auto& mean = means[static_cast<std::size_t>(k)];
        mean = between(means[static_cast<std::size_t>(k - 1)], mean, (at - low) / (high - low));
      }
    }
    return means[static_cast<std::size_t>(degree)];
  }

  void add_span(std::vector<Point>& bezier, int span) const {
    const Point start = blossom(span, 0), next = blossom(span, 1);
    bezier.push_back(start);
    if (direction_.degree == 1) {
      bezier.push_back(between(start, next, 1.0 / 3));
      bezier.push_back(between(start, next, 2.0 / 3));
    } else if (direction_.degree == 2) {
      bezier.push_back(between(start, next, 2.0 / 3));
      bezier.push_back(between(next, blossom(span, 2), 1.0 / 3));
    } else {
      bezier.push_back(next);
      bezier.push_back(blossom(span, 2));
    }
  }

  const SplineDirection& direction_;
  std::span<const Point> points_;
  int count_;
};

// Calls visit(at) for each patch of `width` x `height` Bezier points; at(i, j) is the column and row of its point.
template <typename Visit>
void for_each_patch(std::size_t width, std::size_t height, const SplineDirection& u, const SplineDirection& v,
                    const Visit& visit) {
  for (std::size_t row = 0; row + (v.periodic ? 0 : 1) < height; row += 3)
    for (std::size_t left = 0; left + (u.periodic ? 0 : 1) < width; left += 3)
      visit([&](std::size_t i, std::size_t j) { return std::pair((left + i) % width, (row + j) % height); });
}

// Of each Bezier point along a direction of `points` control points.
std::vector<Mean> means_along(const SplineDirection& direction, std::size_t points) {
  std::vector<Mean> each;
  for (std::uint32_t i = 0; i < points; ++i) each.push_back({{i, 1}});
  return Spline<Mean>(direction, each).bezier_points();
}

// Of rows, and in each row of columns.
Mean product(const Mean& rows, const Mean& columns, std::size_t width) {
  Mean all;
  for (const Term& row : rows)
    for (const Term& column : columns)
      all.push_back({row.point * static_cast<std::uint32_t>(width) + column.point, row.weight * column.weight});
  return all;
}

}  // namespace

SplineDirection uniform_direction(Ends ends, int degree, std::size_t points) {
  const int count = static_cast<int>(points), last = count - degree;
  SplineDirection direction{degree, ends == Ends::periodic, {}};
  const int knots = direction.periodic ? count + 1 : count + degree + 1;
  for (int i = 0; i < knots; ++i) {
    const int even = direction.periodic ? i : i - degree;
    direction.knots.push_back(ends == Ends::clamped ? std::clamp(even, 0, last) : even);
  }
  return direction;
}

Net bezier_patches(const PointGrid& points, const SplineDirection& u, const SplineDirection& v) {
  PointGrid columns;  // of control points, at the Bezier points along u
  for (const auto& row : points) {
    const std::vector<glm::dvec3> bezier = Spline<glm::dvec3>(u, row).bezier_points();
    columns.resize(bezier.size());
    for (std::size_t i = 0; i < bezier.size(); ++i) columns[i].push_back(bezier[i]);
  }
  for (auto& column : columns) column = Spline<glm::dvec3>(v, column).bezier_points();
  const std::size_t width = columns.size(), height = columns[0].size();
  Net net;
  for_each_patch(width, height, u, v, [&](const auto& at) {
    auto& patch = net.emplace_back();
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 4; ++i) {
        const auto [column, row] = at(i, j);
        patch[4 * j + i] = columns[column][row];
      }
  });
  return net;
}

MeanPatches bezier_means(std::size_t columns, std::size_t rows, const SplineDirection& u, const SplineDirection& v) {
  const std::vector<Mean> along_u = means_along(u, columns), along_v = means_along(v, rows);
  MeanPatches net;
  for (const Mean& row : along_v)
    for (const Mean& column : along_u) net.means.push_back(product(row, column, columns));
  const std::size_t width = along_u.size(), height = along_v.size();
  for_each_patch(width, height, u, v, [&](const auto& at) {
    auto& patch = net.patches.emplace_back();
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 4; ++i) {
        const auto [column, row] = at(i, j);
        patch[4 * j + i] = static_cast<std::uint32_t>(row * width + column);
      }
  });
  return net;
}

std::vector<wire::Patch> rounded(const Net& net) {
  std::vector<wire::Patch> patches(net.size());
  for (std::size_t number = 0; number < net.size(); ++number)
    for (std::size_t i = 0; i < 16; ++i)
      for (int axis = 0; axis < 3; ++axis)
        patches[number].points[i][static_cast<std::size_t>(axis)] = static_cast<float>(net[number][i][axis]);
  return patches;
}

}  // namespace mars::modeler
