// Which triangle a line's samples show.
#include "node/kernels/simd.h"

namespace mars::node::MARS_SET {
namespace {

// Whether triangle a is the one seen where both are as near: the lower patch's, then the first within it. None is what
// was there before.
bool precedes(const Triangle* triangles, std::uint32_t a, std::uint32_t b) {
  if (b == kNoTriangle) return false;
  const std::uint32_t patch_a = triangles[a].patch, patch_b = triangles[b].patch;
  return patch_a != patch_b ? patch_a < patch_b : a < b;
}

}  // namespace

Extent draw(const Triangle* triangles, const EdgeBox* boxes, std::uint32_t count, std::uint32_t line,
            float* __restrict depth, std::uint32_t* __restrict ids) {
  Extent extent{0xffffffffu, 0};
  const std::int32_t y = static_cast<std::int32_t>(line) * kSubpixels + kSampleOffset;
  for (std::uint32_t b = 0; b < count; ++b) {
    const EdgeBox& box = boxes[b];
    const Triangle& triangle = triangles[box.triangle];
    extent.first = box.first < extent.first ? box.first : extent.first;
    extent.last = box.last > extent.last ? box.last : extent.last;
    const auto dy = static_cast<float>(y - triangle.first_y);
    const float on_line = triangle.at_first[kDepth] + dy * triangle.per_y[kDepth];
    const std::int32_t from_first = kSampleOffset - triangle.first_x;
    for (std::int32_t column = box.first; column < box.last; ++column) {
      const auto dx = static_cast<float>(column * kSubpixels + from_first);
      const float here = on_line + dx * triangle.per_x[kDepth];
      const bool nearer = here > depth[column] ||
                          (here == depth[column] && precedes(triangles, box.triangle, ids[column]));
      depth[column] = nearer ? here : depth[column];
      ids[column] = nearer ? box.triangle : ids[column];
    }
  }
  return extent;
}

}  // namespace mars::node::MARS_SET
