#include "host/studio/stage/picking.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace mars::studio {
namespace {

using Point = std::array<float, 3>;

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::max()};
  glm::dvec3 high{-std::numeric_limits<double>::max()};

  void add(const Point& point) {
    for (int axis = 0; axis < 3; ++axis) {
      const double at = point[static_cast<std::size_t>(axis)];
      low[axis] = std::min(low[axis], at);
      high[axis] = std::max(high[axis], at);
    }
  }
};

constexpr double kSlack = 1e-6;  // of boxes, for what is flat

// Where the ray enters, in lengths of its way; none: not at all, or behind.
std::optional<double> entry(const Ray& ray, const Bounds& box) {
  double first = 0, last = std::numeric_limits<double>::max();
  for (int axis = 0; axis < 3; ++axis) {
    const double way = ray.way[axis];
    const double low = box.low[axis] - kSlack - ray.from[axis], high = box.high[axis] + kSlack - ray.from[axis];
    if (std::abs(way) < 1e-300) {
      if (low > 0 || high < 0) return std::nullopt;
      continue;
    }
    first = std::max(first, std::min(low / way, high / way));
    last = std::min(last, std::max(low / way, high / way));
  }
  if (first > last) return std::nullopt;
  return first;
}

glm::dvec3 vector(const Point& point) { return {point[0], point[1], point[2]}; }

// Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997; either side.
std::optional<double> distance_to_triangle(const Ray& ray, const Point& a, const Point& b, const Point& c) {
  const glm::dvec3 corner = vector(a), u = vector(b) - corner, v = vector(c) - corner;
  const glm::dvec3 p = glm::cross(ray.way, v);
  const double determinant = glm::dot(u, p);
  if (determinant == 0) return std::nullopt;
  const glm::dvec3 from = ray.from - corner;
  const double along_u = glm::dot(from, p) / determinant;
  if (along_u < 0 || along_u > 1) return std::nullopt;
  const glm::dvec3 q = glm::cross(from, u);
  const double along_v = glm::dot(ray.way, q) / determinant;
  if (along_v < 0 || along_u + along_v > 1) return std::nullopt;
  const double part = glm::dot(v, q) / determinant;
  if (part <= 0) return std::nullopt;
  return part;
}

// The ray in the unit cube that the matrix takes to the world; lengths of its way stay.
std::optional<Ray> in_cube(const Ray& ray, const wire::Matrix& matrix) {
  const auto& m = matrix.m;
  const glm::dmat3 linear(m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1], m[0][2], m[1][2], m[2][2]);
  if (glm::determinant(linear) == 0) return std::nullopt;
  const glm::dmat3 back = glm::inverse(linear);
  return Ray{back * (ray.from - glm::dvec3(m[0][3], m[1][3], m[2][3])), back * ray.way};
}

class NearestHit {
 public:
  explicit NearestHit(const Moments& moments) : moments_(moments), shapes_(moments.shapes()) {}

  void look(std::size_t segment, const Ray& ray) {
    segment_ = segment;
    for (const wire::Patch& patch : moments_.patches_of(segment)) look(patch, ray);
    const std::uint32_t number = moments_.now().segments[segment].shape;
    if (number >= shapes_.shapes.size()) return;
    const wire::Shape& shape = shapes_.shapes[number];
    for (std::uint32_t i = 0; i < shape.meshlet_count; ++i) look(shapes_.meshlets[shape.first_meshlet + i], ray);
  }

  // A segment with a skin; the ray is in the world.
  void look_at_skin(std::size_t segment, const Ray& ray) {
    segment_ = segment;
    const std::vector<wire::Patch> patches = moments_.bent_patches(segment);
    for (std::size_t patch = 0; patch < patches.size(); ++patch)
      if (look(patches[patch], ray)) bone_ = moments_.bone_at(segment, patch, nearest_point(patches[patch], ray));
    const std::uint32_t number = moments_.now().segments[segment].shape;
    if (number >= shapes_.shapes.size()) return;
    const wire::Shape& shape = shapes_.shapes[number];
    for (std::uint32_t i = 0; i < shape.meshlet_count; ++i) {
      const wire::Meshlet& meshlet = shapes_.meshlets[shape.first_meshlet + i];
      const std::vector<Point> places = moments_.bent_places(segment, meshlet);
      Bounds box;
      for (const Point& place : places) box.add(place);
      if (const auto from = entry(ray, box); !from || *from >= part_) continue;
      if (const auto vertex = look(meshlet, places.data(), ray)) bone_ = heaviest_bone(meshlet, *vertex);
    }
  }

  double part() const { return part_; }
  std::optional<std::size_t> segment() const { return nearest_; }
  std::optional<std::uint32_t> bone() const { return bone_; }

 private:
  // Whether it is nearer than what was looked at before.
  bool look(const wire::Patch& patch, const Ray& ray) {
    Bounds box;
    for (const Point& point : patch.points) box.add(point);
    const auto from = entry(ray, box);
    if (!from || *from >= part_) return false;
    const double before = part_;
    diced_.points.clear();
    diced_.corners.clear();
    add_diced(patch, kPatchSteps, diced_);
    for (std::size_t i = 0; i < diced_.corners.size(); i += 3)
      take(distance_to_triangle(ray, diced_.points[diced_.corners[i]], diced_.points[diced_.corners[i + 1]],
                                diced_.points[diced_.corners[i + 2]]));
    return part_ < before;
  }

  // Of the patch's points that which is nearest to where the ray meets it.
  std::size_t nearest_point(const wire::Patch& patch, const Ray& ray) const {
    const glm::dvec3 at = ray.from + part_ * ray.way;
    const auto nearest = std::ranges::min_element(patch.points, {},
                                                  [&](const Point& point) { return glm::distance(vector(point), at); });
    return static_cast<std::size_t>(nearest - patch.points.begin());
  }

  std::uint32_t heaviest_bone(const wire::Meshlet& meshlet, std::uint32_t vertex) const {
    const wire::Skin& skin = meshlet.skin;
    std::uint32_t heaviest = 0;
    const auto weight = [&](std::uint32_t bone) {
      return shapes_.skin_weights[skin.first_weight + bone * meshlet.vertex_count + vertex];
    };
    for (std::uint32_t bone = 1; bone < skin.bone_count; ++bone)
      if (weight(bone) > weight(heaviest)) heaviest = bone;
    return shapes_.skin_bones[skin.first_bone + heaviest];
  }

  void look(const wire::Meshlet& meshlet, const Ray& ray) {
    Bounds box;
    box.add(meshlet.low);
    box.add(meshlet.high);
    const auto from = entry(ray, box);
    if (!from || *from >= part_) return;
    look(meshlet, &shapes_.mesh_places[meshlet.first_vertex], ray);
  }

  // A corner of the triangle that is nearer than what was looked at before, if one is.
  std::optional<std::uint32_t> look(const wire::Meshlet& meshlet, const Point* points, const Ray& ray) {
    std::optional<std::uint32_t> corner;
    for (std::uint32_t i = 0; i < meshlet.triangle_count; ++i) {
      const wire::MeshTriangle& triangle = shapes_.mesh_triangles[meshlet.first_triangle + i];
      if (take(distance_to_triangle(ray, points[triangle[0]], points[triangle[1]], points[triangle[2]])))
        corner = triangle[0];
    }
    return corner;
  }

  bool take(const std::optional<double>& part) {
    if (!part || *part >= part_) return false;
    part_ = *part;
    nearest_ = segment_;
    bone_.reset();
    return true;
  }

  const Moments& moments_;
  const wire::FilmData& shapes_;
  Triangles diced_;
  std::size_t segment_ = 0;
  double part_ = std::numeric_limits<double>::max();
  std::optional<std::size_t> nearest_;
  std::optional<std::uint32_t> bone_;
};

}  // namespace

void add_diced(const wire::Patch& patch, int steps, Triangles& triangles) {
  const auto first = static_cast<std::uint32_t>(triangles.points.size());
  const auto bernstein = [&](int step) {
    const float t = static_cast<float>(step) / static_cast<float>(steps), s = 1 - t;
    return std::array<float, 4>{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  };
  for (int row = 0; row <= steps; ++row) {
    const auto along_v = bernstein(row);
    Point curve[4] = {};  // along u, at this v
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t axis = 0; axis < 3; ++axis) curve[i][axis] += along_v[j] * patch.points[4 * j + i][axis];
    for (int column = 0; column <= steps; ++column) {
      const auto along_u = bernstein(column);
      Point point{};
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) point[axis] += along_u[i] * curve[i][axis];
      triangles.points.push_back(point);
    }
  }
  const auto width = static_cast<std::uint32_t>(steps) + 1;
  for (std::uint32_t row = 0; row + 1 < width; ++row)
    for (std::uint32_t column = 0; column + 1 < width; ++column) {
      const std::uint32_t at = first + row * width + column;
      triangles.corners.insert(triangles.corners.end(), {at, at + 1, at + width + 1, at, at + width + 1, at + width});
    }
}

std::optional<Hit> first_hit(const Moments& moments, const Ray& ray,
                             const std::function<bool(std::size_t segment)>& counts) {
  NearestHit nearest(moments);
  const std::size_t segments = moments.now().segments.size();
  for (std::size_t segment = 0; segment < segments; ++segment) {
    if (!counts(segment)) continue;
    if (moments.now().segments[segment].bone_count > 0) {
      nearest.look_at_skin(segment, ray);
      continue;
    }
    const auto ray_in_cube = in_cube(ray, moments.matrix_of(segment));
    if (!ray_in_cube) continue;
    const auto from = entry(*ray_in_cube, {glm::dvec3(-0.5), glm::dvec3(1.5)});
    if (from && *from < nearest.part()) nearest.look(segment, *ray_in_cube);
  }
  if (!nearest.segment()) return std::nullopt;
  return Hit{*nearest.segment(), ray.from + nearest.part() * ray.way, nearest.bone()};
}

}  // namespace mars::studio
