// What casts shadows: patches and meshlets diced as the camera sees them, so that a surface's shadow is that of the
// triangles that are seen. They are made chunk by chunk, and forgotten.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hal/messages/private_memory.h"
#include "node/geometry/meshlets.h"
#include "node/geometry/scene.h"
#include "node/raster/arena.h"
#include "node/shadow/band.h"
#include "node/shape/dice.h"

namespace mars::shadow {

// A surface in eye space. Arrays are longer by kVectorSlack.
struct Caster {
  const float* place[3];
  std::uint32_t vertices;
  shape::Triangles triangles;
};

class CasterStream {
 public:
  // Whether a surface within the hull of `count` points of eye space, one array an axis, may matter.
  using Matters = std::function<bool(const float* const* points, std::uint32_t count)>;

  explicit CasterStream(simd::InstructionSet set);

  // From now on next() makes the casters of one kind, of the scene as it is.
  void begin(const geometry::Scene& scene, Casting casting);
  // The next chunk, of those that matter; empty at the end.
  std::span<const Caster> next(const Matters& matters);
  // Calls hull(points, count) for each of them.
  void visit_hulls(const geometry::Scene& scene, Casting casting,
                   const std::function<void(const float* const*, std::uint32_t)>& hull) const;

 private:
  bool add_patch(const wire::Patch& patch, const Matters& matters);
  bool add_meshlet(const wire::Meshlet& meshlet, const Matters& matters);
  void add(const shape::Surface& surface);
  bool is_full() const { return arena_.rest().size() < kMostBytes; }

  static const std::size_t kMostBytes;  // of a caster

  shape::Dicer dicer_;
  geometry::MeshletPlacer placer_;
  messages::PrivateMemory memory_;
  raster::Arena arena_;
  std::vector<Caster> chunk_;
  const geometry::Scene* scene_ = nullptr;
  Casting casting_ = Casting::still;
  std::size_t segment_ = 0;  // the next
  std::uint64_t item_ = 0;   // of its patches and meshlets
  shape::EyeMatrix matrix_{};
  shape::EyeMap map_{};
};

}  // namespace mars::shadow
