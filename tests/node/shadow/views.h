// Lights, their views and points on these, for tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "node/shadow/kernels.h"
#include "node/shadow/light_views.h"
#include "node/simd/vector_slack.h"
#include "tests/node/shape/patches.h"

namespace mars::shadow {

inline const shape::Projection kPicture = shape::projection(200, 150, 2, 0.1, 1000);

inline shape::Vec3 random_way(shape::Random& random) {
  for (;;) {
    const shape::Vec3 way{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
    const double l = shape::length(way);
    if (l > 0.1 && l <= 1) return {way[0] / l, way[1] / l, way[2] / l};
  }
}

inline geometry::EyeLight random_light(shape::Random& random, wire::LightKind kind, double size = 0) {
  geometry::EyeLight light{};
  light.kind = kind;
  const shape::Vec3 way = random_way(random), axis = random_way(random);
  const double far = kind == wire::LightKind::directional ? 1 : 10;
  for (std::size_t k = 0; k < 3; ++k) {
    light.vector[k] = static_cast<float>(way[k] * far);
    light.axis[k] = static_cast<float>(axis[k]);
  }
  light.cos_outer = 0.9f;
  light.cos_inner = 0.95f;
  light.casts = 1;
  light.size = static_cast<float>(size);
  return light;
}

inline double along(const float* axis, const shape::Vec3& way) {
  return axis[0] * way[0] + axis[1] * way[1] + axis[2] * way[2];
}

// Vertices on a grid.
struct Grid {
  explicit Grid(std::size_t count)
      : x(count + simd::kVectorSlack), y(count + simd::kVectorSlack), z(count + simd::kVectorSlack) {}
  GridVertices vertices() { return {x.data(), y.data(), z.data()}; }

  std::vector<std::int32_t> x, y;
  std::vector<float> z;
};

// Triangles of some vertices, in batches of at most `a_batch`.
class Mesh {
 public:
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { a_.push_back(a), b_.push_back(b), c_.push_back(c); }
  void finish(std::uint32_t a_batch) {
    count_ = static_cast<std::uint32_t>(a_.size());
    for (auto* corner : {&a_, &b_, &c_}) corner->resize(count_ + simd::kVectorSlack);
    for (std::uint32_t k = 0; k < count_; k += a_batch) batches.push_back({k, std::min(k + a_batch, count_), false});
  }
  std::uint32_t count() const { return count_; }
  shape::Triangles triangles() const {
    return {a_.data(), b_.data(), c_.data(), count_, batches.data(), static_cast<std::uint32_t>(batches.size())};
  }

  std::vector<shape::Batch> batches;

 private:
  std::uint32_t count_ = 0;
  std::vector<std::uint32_t> a_, b_, c_;
};

struct GridPoint {
  std::int32_t x, y;
};

// Of sixteen points each, the last one's other lanes inactive; the plane near them is level.
inline std::vector<PointVector> vectors_of(const std::vector<GridPoint>& points, float z, float error = 0) {
  std::vector<PointVector> out;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t lane = k % kPointLanes;
    if (lane == 0) {
      out.push_back(PointVector{});
      out.back().box = {points[k].x, points[k].x, points[k].y, points[k].y, z, z};
      out.back().least = z;
    }
    PointVector& v = out.back();
    v.x[lane] = points[k].x, v.y[lane] = points[k].y, v.z[lane] = z;
    v.error[lane] = error;
    v.active |= 1u << lane;
    v.box.low_x = std::min(v.box.low_x, points[k].x), v.box.high_x = std::max(v.box.high_x, points[k].x);
    v.box.low_y = std::min(v.box.low_y, points[k].y), v.box.high_y = std::max(v.box.high_y, points[k].y);
  }
  return out;
}

}  // namespace mars::shadow
