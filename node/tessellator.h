// The first step of a frame: a node's share of the patches and meshlets, scattered as i, i + P, i + 2P ..., becomes
// triangles, their edge boxes counted line by line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/geometry/meshlets.h"
#include "node/geometry/scene.h"
#include "node/geometry/segment_place.h"
#include "node/group/passes.h"
#include "node/heartbeat.h"
#include "node/raster/arena.h"
#include "node/raster/scanline.h"
#include "node/raster/setup.h"
#include "node/shadow/casters.h"
#include "node/shading/colored_surface.h"
#include "node/shape/dice.h"
#include "node/wire/protocol.h"

namespace mars::node {

// Patches and meshlets whose number is `index` modulo `count`, none where that is no remainder; or those whose number
// has one of several remainders, with 1 in `remainders`.
struct Scatter {
  std::uint32_t index = 0;
  std::uint32_t count = 1;
  std::span<const std::uint8_t> remainders{};

  bool any() const;
  // The first of them from `number` on.
  std::uint64_t from(std::uint64_t number) const;
};

// Surfaces that surely touch none of the lines are not made.
struct OwnLines {
  const geometry::ShapeBoxes& boxes;
  geometry::LineRange lines;
};

// One a line of the picture.
struct LineTable {
  std::span<const std::uint8_t> wanted;        // 1: edge boxes of moving parts there are stored and counted
  std::span<const std::uint8_t> wanted_still;  // of stationary ones, which are not made where it is empty
  std::span<raster::LineLoad> loads;
  const OwnLines* own = nullptr;  // none: surfaces of all lines are made
};

// Where triangles go: they count from `first`, whole triangles before the arena.
struct TriangleSpace {
  raster::Arena& arena;
  geometry::Triangle* first;
};

// Surfaces that triangles were made of.
struct SurfaceCounts {
  std::uint64_t patches = 0;
  std::uint64_t meshlets = 0;
  std::uint64_t vertices = 0;       // of patches
  std::uint64_t mesh_vertices = 0;  // of meshlets
  std::uint64_t net_terms = 0;      // by which bones bend patches
  std::uint64_t skin_weights = 0;   // by which they bend meshlets
  std::uint64_t dual_weights = 0;
  std::uint64_t colored = 0;  // vertices and flat triangles that were shaded
};

// One of them, as it was made.
struct SurfaceMark {
  std::uint32_t patch;  // its number
  geometry::Bending bending;
  std::uint64_t vertices, triangles_tested, colored;
  std::uint64_t triangles, edge_boxes;  // on wanted lines
};

// Who is interested in each surface; either may be nullptr.
struct SurfaceWatch {
  shadow::DicedSurfaces* diced = nullptr;     // gets the surfaces
  std::vector<SurfaceMark>* marks = nullptr;  // gets what was made of them, in their order
};

struct Tessellation {
  raster::Polygons polygons;
  SurfaceCounts surfaces;
  group::MadeCounts made;  // on wanted lines, whether stored or not
  bool all_stored;         // else memory was short
};

class Tessellator {
 public:
  // `heartbeat` is looked after now and then; nullptr: there is none.
  explicit Tessellator(simd::InstructionSet set, Heartbeat* heartbeat = nullptr);

  // Triangles of the scatter's patches and meshlets at the scene's frame, in the order of polygon numbers. They lie in
  // `space`. Sets `lines.loads`, and the patches and vertices of `work`.
  Tessellation tessellate(const geometry::Scene& scene, const Scatter& scatter, const LineTable& lines,
                          const TriangleSpace& space, wire::WorkCounts& work, const SurfaceWatch& watch = {});

 private:
  struct Output;
  // What of a segment may touch own lines.
  enum class Touches { nothing, perhaps, only };

  void add(const geometry::Scene& scene, bool moving, const Scatter& scatter, Output& output);
  // Those of its patches and meshlets that move, or those that stand still.
  void add_segment(const geometry::Scene& scene, std::size_t segment, bool moving, const Scatter& scatter,
                   Output& output);
  // Of the segment that place_ is of.
  Touches touches(const geometry::Scene& scene, const OwnLines* own) const;
  // Of the segment's shape, by its number.
  void add_patch(const geometry::Scene& scene, std::size_t number, const raster::PatchIdentity& identity,
                 Output& output);
  void add_meshlet(const geometry::Scene& scene, const wire::Meshlet& meshlet, const raster::PatchIdentity& identity,
                   Output& output);

  void look_now_and_then() {
    if (heartbeat_ != nullptr) heartbeat_->look_now_and_then();
  }

  simd::InstructionSet instruction_set_;
  Heartbeat* heartbeat_;
  geometry::SegmentPlace place_;  // of the current segment
  shape::Dicer dicer_;
  geometry::MeshletPlacer placer_;
  shading::ColoredSurface colored_;
};

}  // namespace mars::node
