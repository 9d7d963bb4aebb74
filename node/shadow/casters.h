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
#include "node/geometry/segment_place.h"
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
  const float* place[3];
  std::uint32_t vertices;
  shape::Triangles triangles;
};

// Copies of surfaces, until there is no room for more.
class CasterStore {
 public:
  // A caster, together with its places in lists, has about as many.
  static constexpr std::size_t kBytesACaster = 2048;
  // Of a surface, at most, but for these places; and of a store that has room for one.
  static constexpr std::size_t kMostBytes =
      (std::size_t{shape::Dicer::kMostVertices} + simd::kVectorSlack) * 3 * sizeof(float) +
      (std::size_t{2} * shape::kMaxRate * shape::kMaxRate + 4 * shape::kMaxRate + simd::kVectorSlack) * 3 *
          sizeof(std::uint32_t) +
      std::size_t{2} * shape::kMaxRate * shape::kMaxRate * sizeof(shape::Batch) / 8 + 4096;
  static constexpr std::size_t kLeastBytes = kMostBytes * 8 / 5;

  // `bytes`: of all that it has, and of `beside` for each caster elsewhere.
  explicit CasterStore(std::size_t bytes, std::size_t beside = 0);

  void clear();
  bool has_room() const;
  std::size_t most() const { return most_; }  // casters
  // Where it has room.
  const Caster& add(const shape::Surface& surface);
  std::span<const Caster> all() const { return casters_; }

 private:
  shape::Triangles copy(const shape::Triangles& triangles);
  template <typename T>
  const T* copy(const T* from, std::size_t count);

  std::size_t most_;
  messages::PrivateMemory memory_;
  raster::Arena arena_;
  std::vector<Caster> casters_;
};

// Bytes of chunks of casters, and of surfaces diced for the camera, where there is enough memory (shadow_plan.h).
inline constexpr std::size_t kMostChunk = std::size_t{32} << 20, kMostDiced = std::size_t{64} << 20;

// Surfaces that need not be diced again: moving ones that were diced for the camera in this frame, and still ones that
// were diced for anything since their interval began.
class DicedSurfaces {
 public:
  explicit DicedSurfaces(std::uint64_t patches, std::size_t bytes = kMostDiced);

  // Forgets those of one kind.
  void clear(Casting kind);
  // Keeps surface number `patch`, if it is not kept already; nullptr where there is no room.
  const Caster* keep(Casting kind, std::uint32_t patch, const shape::Surface& surface);
  // nullptr where it is not kept.
  const Caster* find(std::uint32_t patch) const { return kept_[patch]; }

 private:
  struct Kind {
    CasterStore store;
    std::vector<std::uint32_t> patches;
  };
  Kind& of(Casting kind) { return kind == Casting::still ? still_ : moving_; }

  Kind still_, moving_;
  std::vector<const Caster*> kept_;  // by patch
};

// One of a chunk.
struct ChunkCaster {
  Hull hull;
  const Caster* surface;
  std::uint32_t patch;
  bool is_new;  // it was diced for this chunk
};

class CasterStream {
 public:
  // Whether a surface within the hull may matter.
  using Matters = std::function<bool(const Hull& hull)>;

  explicit CasterStream(simd::InstructionSet set, std::size_t bytes = kMostChunk);

  // From now on next() makes the casters of one kind, of the scene as it is; those that are in `diced` are taken from
  // there, and still ones kept there.
  void begin(const geometry::Scene& scene, Casting casting, DicedSurfaces& diced);
  // The next chunk, of those that matter; empty at the end.
  std::span<const ChunkCaster> next(const Matters& matters);
  // Calls visit(hull) for each of that kind.
  void visit_hulls(const geometry::Scene& scene, Casting casting, const std::function<void(const Hull&)>& visit);

 private:
  void add_item(const wire::Shape& shape, std::uint32_t number, const Matters& matters);
  const Caster& add(std::uint32_t patch, const shape::Surface& surface);
  const shape::Surface& dice(std::size_t patch);
  const shape::Surface& place(const wire::Meshlet& meshlet);

  shape::Dicer dicer_;
  geometry::MeshletPlacer placer_;
  CasterStore store_;
  std::vector<ChunkCaster> chunk_;
  const geometry::Scene* scene_ = nullptr;
  DicedSurfaces* diced_ = nullptr;
  Casting casting_ = Casting::still;
  std::size_t segment_ = 0;       // the next
  std::uint64_t item_ = 0;        // of its patches and meshlets
  geometry::SegmentPlace place_;  // of that segment
};

}  // namespace mars::shadow
