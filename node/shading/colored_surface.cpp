#include "node/shading/colored_surface.h"

#include <algorithm>
#include <cstddef>

#include "node/shape/dice.h"
#include "node/wire/film_parts.h"

namespace mars::shading {
namespace {

constexpr std::uint32_t kFlat = ColoredSurface::kFlatTriangles;
constexpr std::size_t kMiddles = kFlat + simd::kVectorSlack;  // stride of their arrays

struct Vector {
  float x, y, z;
};

Vector at(float* const* arrays, std::uint32_t k) { return {arrays[0][k], arrays[1][k], arrays[2][k]}; }
Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator*(float s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
float dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Of a triangle's plane; the vertices' where its corners are in a line but for rounding. Turned to the eye; any length.
Vector normal_to_eye(const shape::Vertices& v, const shape::Corner3& corners, const Vector& from_eye) {
  constexpr float kRounding = 1e-6f;
  const Vector a = at(v.place, corners.a), b = at(v.place, corners.b) - a, c = at(v.place, corners.c) - a;
  Vector normal = cross(b, c);
  if (dot(normal, normal) <= kRounding * kRounding * dot(b, b) * dot(c, c))
    normal = at(v.normal, corners.a) + at(v.normal, corners.b) + at(v.normal, corners.c);
  return dot(normal, from_eye) > 0 ? -1.0f * normal : normal;
}

}  // namespace

ColoredSurface::Colors::Colors(std::size_t vertices)
    : stride(vertices + simd::kVectorSlack),
      numbers(new float[3 * stride]),
      values(new float[stride][shape::kValues]) {}

shape::VertexColors ColoredSurface::Colors::view() const {
  return {{numbers.get(), numbers.get() + stride, numbers.get() + 2 * stride}, values.get()};
}

// Its own vertices are those of by_triangles: all first corners, then all second, then all third ones.
ColoredSurface::ColoredSurface(simd::InstructionSet set)
    : Surface(set, 3 * kFlat, kFlat, kFlat / shape::kBatchTriangles),
      shading_kernels_(shading_kernels(set)),
      own_(vertices_),
      own_triangles_(triangles_),
      outside_(shape::Dicer::kMostVertices),
      inside_(shape::Dicer::kMostVertices),
      sides_{outside_.view(), inside_.view()},
      middles_(new float[6 * kMiddles]) {}

const shape::Surface& ColoredSurface::by_vertices(const shape::Surface& surface, const Coloring& coloring) {
  vertices_ = surface.vertices();
  vertex_count_ = surface.vertex_count();
  triangles_ = surface.triangles();
  reaches_outside_ = surface.reaches_outside();
  const auto count = static_cast<std::uint32_t>(vertex_count_);
  const auto shade = [&](float side, const shape::VertexColors& out) {
    shading_kernels_.shade_vertices(coloring.shading, coloring.material, side, vertices_, count, out);
  };
  sides_[0] = outside_.view(), sides_[1] = inside_.view();
  if (coloring.outside) shade(1, sides_[0]);
  if (coloring.inside) shade(-1, sides_[1]);
  vertices_.colors = sides_;
  return *this;
}

const shape::Surface& ColoredSurface::by_triangles(const shape::Surface& surface, std::uint32_t first,
                                                   const Coloring& coloring) {
  const shape::Triangles& triangles = surface.triangles();
  const std::uint32_t count = std::min(kFlat, triangles.count - first);
  vertices_ = own_;
  triangles_ = own_triangles_;
  vertex_count_ = 3 * kFlat;
  reaches_outside_ = surface.reaches_outside();
  clear_triangles();
  for (std::uint32_t k = 0; k < count; ++k)
    add(static_cast<std::int32_t>(k), static_cast<std::int32_t>(kFlat + k), static_cast<std::int32_t>(2 * kFlat + k));
  end_batches(true);
  copy_corners(surface.vertices(), triangles.a + first, 0, count);
  copy_corners(surface.vertices(), triangles.b + first, kFlat, count);
  copy_corners(surface.vertices(), triangles.c + first, 2 * kFlat, count);
  const bool parallel = coloring.shading.projection.parallel;
  find_middles(surface.vertices(), triangles, first, count, parallel);
  shape::Vertices middles = own_;  // the values' 1 / w are those of the first corners
  for (std::size_t axis = 0; axis < 3; ++axis) {
    middles.place[axis] = middles_.get() + axis * kMiddles;
    middles.normal[axis] = middles_.get() + (3 + axis) * kMiddles;
  }
  sides_[0] = sides_[1] = outside_.view();
  shading_kernels_.shade_vertices(coloring.shading, coloring.material, 1, middles, count, sides_[0]);
  spread_colors(count, parallel);
  vertices_.colors = sides_;
  return *this;
}

void ColoredSurface::copy_corners(const shape::Vertices& from, const std::uint32_t* corners, std::uint32_t at,
                                  std::uint32_t count) {
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t corner = corners[k];
    for (int axis = 0; axis < 3; ++axis) {
      own_.place[axis][at + k] = from.place[axis][corner];
      own_.normal[axis][at + k] = from.normal[axis][corner];
    }
    std::copy_n(from.values[corner], shape::kValues, own_.values[at + k]);
    own_.x[at + k] = from.x[corner];
    own_.y[at + k] = from.y[corner];
    own_.outside[at + k] = from.outside[corner];
  }
}

void ColoredSurface::find_middles(const shape::Vertices& from, const shape::Triangles& triangles, std::uint32_t first,
                                  std::uint32_t count, bool parallel) {
  for (std::uint32_t k = 0; k < count; ++k) {
    const shape::Corner3 corners = triangles[first + k];
    const Vector middle =
        (1.0f / 3) * (at(from.place, corners.a) + at(from.place, corners.b) + at(from.place, corners.c));
    const Vector normal = normal_to_eye(from, corners, parallel ? Vector{0, 0, -1} : middle);
    const float numbers[] = {middle.x, middle.y, middle.z, normal.x, normal.y, normal.z};
    for (std::size_t i = 0; i < 6; ++i) middles_[i * kMiddles + k] = numbers[i];
  }
}

// Second and third corners get the first one's.
void ColoredSurface::spread_colors(std::uint32_t count, bool parallel) {
  const shape::VertexColors& colors = sides_[0];
  for (std::uint32_t from = kFlat; from <= 2 * kFlat; from += kFlat)
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t corner = from + k;
      const float depth = own_.values[corner][shape::kDepth], inverse_w = parallel ? 1 : depth;
      colors.values[corner][shape::kDepth] = depth;
      for (int c = 0; c < 3; ++c) {
        colors.color[c][corner] = colors.color[c][k];
        colors.values[corner][1 + c] = inverse_w * colors.color[c][k];
      }
    }
}

}  // namespace mars::shading
