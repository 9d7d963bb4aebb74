// Dices one patch at a time to vertices and triangles: a grid inside, each side at its own rate and in its
// own canonical direction, and triangles that stitch the two. A patch that is flat in one direction becomes a
// single strip between two sides. The same patch always gives the same triangles in the same order.
#pragma once

#include <cstdint>

#include "node/shape/bezier.h"
#include "node/shape/surface.h"

namespace mars::shape {

class Dicer : public Surface {
 public:
  static constexpr int kMostVertices = (kMaxRate - 1) * (kMaxRate - 1) + 4 * (kMaxRate + 1);

  explicit Dicer(simd::InstructionSet set);

  // Becomes the surface of `patch`, until the next call.
  void dice(const EyePatch& patch, const Projection& projection, const Dicing& dicing);

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

  void lay_out(const Rates& wanted);
  // Whether all vertices that the function computes have a normal.
  bool evaluate_inside(const EyePatch& patch);
  bool evaluate_side(const EyePatch& patch, Side side);
  void mend_normals(const EyePatch& patch);
  void mend_normal(const EyePatch& patch, int vertex, float u, float v);
  void triangulate();
  void fill_inside();
  void stitch(const Chain& outer, const Chain& inner);

  Chain side_chain(Side side) const;   // counter-clockwise round the patch
  Chain inner_chain(Side side) const;  // the inside's outermost row along that side

  Rates rates_{};
  Rates triangulated_{};  // what the triangles are for
  bool flat_in_v_ = false;
  int columns_ = 0;  // of the inside grid; 0 for a strip
  int rows_ = 0;
  int side_at_[4] = {};  // first vertex of each side, in the direction of u or v
};

}  // namespace mars::shape
