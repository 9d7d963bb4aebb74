// A diced patch's triangles become set-ups: snapped, clipped where they must be (at near and far, and at a
// guard band far outside the picture; a shared edge is cut at the same place by both its triangles), with
// their plane equations. Those that touch no sample are dropped.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "node/dice.h"
#include "node/edge_boxes.h"

namespace mars::node {

// What a patch's triangles have in common.
struct PatchIdentity {
  std::uint32_t patch;
  std::uint32_t look;
  bool mirrored;   // its matrix turns shapes inside out
  bool one_sided;  // triangles seen from inside are dropped
};

// Where set-ups go. Those that no longer fit `triangles` are still counted.
struct SetUps {
  std::span<Triangle> triangles;
  std::span<std::uint32_t> line_counts;      // edge boxes a line; empty where they are known already
  std::span<const std::uint8_t> wanted_lines;  // 1: kept if it touches such a line; empty: all
  std::size_t stored = 0;
  std::uint64_t touching = 0;  // triangles with a sample, stored or not
  std::uint64_t edge_boxes = 0;
};

class SetUp {
 public:
  SetUp(const Kernels& kernels, const Projection& projection, std::int32_t width, std::int32_t height);

  void add(const Dicer& diced, const PatchIdentity& identity, SetUps& out) const;

 private:
  // A diced triangle's number, and whether its outside by the order of its vertices is turned to the eye, if
  // that is known already (pieces of a clipped one share it).
  struct Facing {
    std::uint32_t index;
    std::optional<bool> eye;
  };
  void add_clipped(const Vertices& vertices, const Corner3& corners, const Facing& facing,
                   const PatchIdentity& identity, SetUps& out) const;
  void add_triangle(const Vertices& vertices, const Corner3& corners, const Facing& facing,
                    const PatchIdentity& identity, SetUps& out) const;
  void keep(const Triangle& triangle, SetUps& out) const;

  const Kernels& kernels_;
  Projection projection_;
  std::int32_t width_;
  std::int32_t height_;
};

}  // namespace mars::node
