// A surface whose triangles carry colours instead of normals: shaded once a vertex or once a triangle, before set-up
// (wire::Interpolation). It shares the other surface's arrays or has its own; made again for each, in the same memory.
#pragma once

#include <cstdint>
#include <memory>

#include "node/shading/kernels.h"
#include "node/shape/surface.h"

namespace mars::shading {

// What is shaded, and from which sides it is to be seen.
struct Coloring {
  const Shading& shading;
  std::uint32_t material;
  bool outside;
  bool inside;
};

class ColoredSurface : public shape::Surface {
 public:
  static constexpr std::uint32_t kFlatTriangles = 1024;

  explicit ColoredSurface(simd::InstructionSet set);

  // Gouraud's: colours of the vertices, which triangles interpolate. Valid as long as `surface`.
  const shape::Surface& by_vertices(const shape::Surface& surface, const Coloring& coloring);

  // Triangles [first, first + kFlatTriangles) of `surface`, or fewer at its end, each with one colour: that of its
  // middle, its plane's normal turned to the eye. They share no vertices.
  const shape::Surface& by_triangles(const shape::Surface& surface, std::uint32_t first, const Coloring& coloring);

 private:
  struct Colors {
    explicit Colors(std::size_t vertices);
    shape::VertexColors view() const;

    std::size_t stride;
    std::unique_ptr<float[]> numbers;
    std::unique_ptr<float[][shape::kValues]> values;
  };

  void copy_corners(const shape::Vertices& from, const std::uint32_t* corners, std::uint32_t at, std::uint32_t count);
  void find_middles(const shape::Vertices& from, const shape::Triangles& triangles, std::uint32_t first,
                    std::uint32_t count, bool parallel);
  void spread_colors(std::uint32_t count, bool parallel);

  const ShadingKernels& shading_kernels_;
  const shape::Vertices own_;
  const shape::Triangles own_triangles_;
  Colors outside_;
  Colors inside_;
  shape::VertexColors sides_[2];
  std::unique_ptr<float[]> middles_;
};

}  // namespace mars::shading
