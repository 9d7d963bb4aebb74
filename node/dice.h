// Dices one patch at a time to vertices and triangles: a grid inside, each side at its own rate and in its
// own canonical direction, and triangles that stitch the two. A patch that is flat in one direction becomes a
// single strip between two sides. The same patch always gives the same triangles in the same order.
#pragma once

#include <cstdint>
#include <memory>

#include "node/bezier.h"
#include "node/kernels.h"

namespace mars::node {

class Dicer {
 public:
  explicit Dicer(const Kernels& kernels);

  // Vertices (projected) and triangles of `patch`; both hold until the next call. Normals are the outside's.
  void dice(const EyePatch& patch, const Projection& projection, int fixed_rate);

  const Vertices& vertices() const { return vertices_; }
  int vertex_count() const { return vertex_count_; }
  const Triangles& triangles() const { return triangles_; }
  bool reaches_outside() const { return reaches_outside_; }  // whether any vertex is outside

 private:
  // A row of vertices along one side of a stitched band, with the place of each along that side:
  // vertex k is first + k * stride, at (from + k) / of.
  struct Chain {
    std::int32_t first;
    std::int32_t stride;
    std::int32_t steps;
    std::int32_t from;
    std::int32_t of;
  };

  void lay_out(const Rates& rates);
  // Whether all of these vertices have a normal.
  bool evaluate_inside(const EyePatch& patch);
  bool evaluate_side(const EyePatch& patch, Side side);
  void mend_normals(const EyePatch& patch);
  void mend_normal(const EyePatch& patch, int vertex, float u, float v);
  void triangulate();
  void fill_inside();
  void stitch(const Chain& outer, const Chain& inner);
  void add(std::int32_t a, std::int32_t b, std::int32_t c);
  void end_batches(bool consecutive);

  Chain side_chain(Side side) const;   // counter-clockwise round the patch
  Chain inner_chain(Side side) const;  // the inside's outermost row along that side

  const Kernels& kernels_;
  std::unique_ptr<float[]> numbers_;
  std::unique_ptr<std::int32_t[]> places_;
  std::unique_ptr<std::uint8_t[]> flags_;
  std::unique_ptr<float[][kValues]> values_;
  std::unique_ptr<std::uint32_t[]> corners_;
  std::unique_ptr<Batch[]> batches_;
  Vertices vertices_;
  Triangles triangles_{};
  bool reaches_outside_ = false;
  Rates rates_{};
  Rates triangulated_{};  // what triangles_ are for
  bool flat_in_v_ = false;
  int columns_ = 0;       // of the inside grid; 0 for a strip
  int rows_ = 0;
  int side_at_[4] = {};   // first vertex of each side, in the direction of u or v
  int vertex_count_ = 0;
};

}  // namespace mars::node
