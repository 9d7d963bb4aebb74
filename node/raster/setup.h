// A surface's triangles become set-ups: snapped, clipped where they must be (at near and far, and at a
// guard band far outside the picture; a shared edge is cut at the same place by both its triangles), with
// their plane equations and edge boxes. Those that touch no sample are dropped.
//
// Sixteen at a time where they are small and surely turned one way (kernels.h, classify); the rest one by one.
// Both decide the same, bit for bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "node/raster/classified.h"
#include "node/raster/kernels.h"
#include "node/shape/surface.h"

namespace mars::raster {

// Set-ups and their edge boxes in one piece of memory: triangles from its front (aligned to a cache line), their
// edge boxes from its end towards the front. What no longer fits is still counted.
struct SetUps : SetUpSpace {
  // Edge boxes name triangles by their distance from `first`, whole cache lines before `memory`.
  // A pixel has as many samples as `pattern`.
  SetUps(std::span<std::byte> memory, geometry::Triangle* first, const shape::SamplePattern& pattern,
         std::span<LineLoad> line_loads);

  // Of what is added from now on: edge boxes on lines with 1 are stored and counted.
  void want(std::span<const std::uint8_t> lines) { wanted_lines = lines.data(); }

  std::span<const geometry::Triangle> triangles() const { return {begin, static_cast<std::size_t>(next - begin)}; }
  // The latest first.
  std::span<const UnsortedEdgeBox> boxes() const { return {last_box, static_cast<std::size_t>(end - last_box)}; }
  bool all_stored() const { return boxes().size() == edge_boxes; }
  std::size_t bytes_left() const;

  geometry::Triangle* begin;
  UnsortedEdgeBox* end;
  std::uint64_t touching = 0;  // triangles with an edge box, stored or not
  std::uint64_t edge_boxes = 0;
};

class SetUp {
 public:
  // For a picture of width x height pixels. `casting`: lights cast shadows, so that samples must lie on their triangles
  // within what node/shadow/light_view.h says, those of clipped triangles too.
  SetUp(simd::InstructionSet set, const shape::Projection& projection, std::int32_t width, std::int32_t height,
        const shape::SamplePattern& pattern, bool casting = false);

  void add(const shape::Surface& surface, const PatchIdentity& identity, SetUps& out);
  // The same without the sixteen at a time: the plain twin.
  void add_plainly(const shape::Surface& surface, const PatchIdentity& identity, SetUps& out) const;

 private:
  void add_one(const shape::Vertices& vertices, const shape::Corner3& corners, const PatchIdentity& identity,
               SetUps& out) const;
  void add_clipped(const shape::Vertices& vertices, const shape::Corner3& corners, const PatchIdentity& identity,
                   SetUps& out) const;
  // `known`: whether its outside by the order of its vertices is turned to the eye, where that is known already.
  void add_whole(const shape::Vertices& vertices, const shape::Corner3& corners, std::optional<bool> known,
                 const PatchIdentity& identity, SetUps& out) const;
  void add_batch(const shape::Vertices& vertices, const shape::Triangles& triangles, const shape::Batch& batch,
                 const PatchIdentity& identity, SetUps& out) const;

  const shape::ShapeKernels& shape_kernels_;
  const RasterKernels& kernels_;
  shape::Projection projection_;
  std::int32_t width_;
  std::int32_t height_;
  shape::SamplePattern pattern_;
  bool casting_;
  Classified classified_;
};

}  // namespace mars::raster
