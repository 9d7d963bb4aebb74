#include "node/shape/surface.h"

#include <algorithm>
#include <cstddef>

namespace mars::shape {

Surface::Surface(simd::InstructionSet set, int most_vertices, int most_triangles, int most_batches)
    : kernels_(shape_kernels(set)), stride_(static_cast<std::uint32_t>(most_triangles + simd::kVectorSlack)) {
  const std::size_t vertices = static_cast<std::size_t>(most_vertices) + simd::kVectorSlack;
  numbers_.reset(new float[6 * vertices]);
  places_.reset(new std::int32_t[2 * vertices]);
  flags_.reset(new std::uint8_t[vertices]);
  values_.reset(new float[vertices][kValues]);
  corners_.reset(new std::uint32_t[3 * stride_]());
  batches_.reset(new Batch[static_cast<std::size_t>(most_batches)]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    vertices_.place[axis] = numbers_.get() + axis * vertices;
    vertices_.normal[axis] = numbers_.get() + (3 + axis) * vertices;
  }
  vertices_.values = values_.get();
  vertices_.x = places_.get();
  vertices_.y = places_.get() + vertices;
  vertices_.outside = flags_.get();
  const std::uint32_t* corners = corners_.get();
  triangles_ = {corners, corners + stride_, corners + 2 * stride_, 0, batches_.get(), 0};
}

void Surface::end_batches(bool consecutive) {
  std::uint32_t first = triangles_.batch_count == 0 ? 0 : batches_[triangles_.batch_count - 1].last;
  while (first < triangles_.count) {
    const std::uint32_t last = std::min(first + kBatchTriangles, triangles_.count);
    batches_[triangles_.batch_count++] = {first, last, consecutive};
    first = last;
  }
}

}  // namespace mars::shape
