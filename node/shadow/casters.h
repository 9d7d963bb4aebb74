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

// Points of eye space round a surface, one array an axis, which is longer by kVectorSlack.
struct Hull {
  float along[3][16 + simd::kVectorSlack];
  std::uint32_t count = 0;
};

// A surface in eye space. Arrays are longer by kVectorSlack.
struct Caster {
  Hull hull;
  const float* place[3];
  std::uint32_t vertices;
  shape::Triangles triangles;
};

class CasterStream {
 public:
  // Whether a surface within the hull may matter.
  using Matters = std::function<bool(const Hull& hull)>;

  explicit CasterStream(simd::InstructionSet set);

  // From now on next() makes the casters of one kind, of the scene as it is.
  void begin(const geometry::Scene& scene, Casting casting);
  // The next chunk, of those that matter; empty at the end.
  std::span<const Caster> next(const Matters& matters);
  // Calls visit(hull) for each of that kind.
  void visit_hulls(const geometry::Scene& scene, Casting casting, const std::function<void(const Hull&)>& visit) const;

 private:
  void add_patch(const wire::Patch& patch, const Matters& matters);
  void add_meshlet(const wire::Meshlet& meshlet, const Matters& matters);
  void add(const shape::Surface& surface, const Hull& hull);
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
