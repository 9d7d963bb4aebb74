// The input of set-up: a diced patch (dice.h) or a meshlet (meshlets.h) in eye space, its vertices projected, its
// triangles in batches. Made again for each, in the same memory.
#pragma once

#include <cstdint>
#include <memory>

#include "node/shape/kernels.h"

namespace mars::shape {

class Surface {
 public:
  // Normals are the outside's.
  const Vertices& vertices() const { return vertices_; }
  int vertex_count() const { return vertex_count_; }
  const Triangles& triangles() const { return triangles_; }
  bool reaches_outside() const { return reaches_outside_; }  // whether any vertex is outside

 protected:
  Surface(simd::InstructionSet set, int most_vertices, int most_triangles, int most_batches);

  void project(const Projection& projection) {
    reaches_outside_ = kernels_.project(projection, vertices_, vertex_count_);
  }

  void clear_triangles() { triangles_.count = triangles_.batch_count = 0; }
  void add(std::int32_t a, std::int32_t b, std::int32_t c) {
    const std::uint32_t k = triangles_.count++;
    corners_[k] = static_cast<std::uint32_t>(a);
    corners_[stride_ + k] = static_cast<std::uint32_t>(b);
    corners_[2 * stride_ + k] = static_cast<std::uint32_t>(c);
  }
  // Cuts the triangles added since the last time into batches.
  void end_batches(bool consecutive);

  const ShapeKernels& kernels_;
  Vertices vertices_;
  Triangles triangles_{};
  int vertex_count_ = 0;
  bool reaches_outside_ = false;

 private:
  std::unique_ptr<float[]> numbers_;
  std::unique_ptr<std::int32_t[]> places_;
  std::unique_ptr<std::uint8_t[]> flags_;
  std::unique_ptr<float[][kValues]> values_;
  std::unique_ptr<std::uint32_t[]> corners_;
  std::unique_ptr<Batch[]> batches_;
  std::uint32_t stride_;  // of corners_
};

}  // namespace mars::shape
