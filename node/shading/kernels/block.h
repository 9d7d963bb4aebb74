// What the kernels of this folder work on: a block of samples without gaps, whichever line, fragments or vertices they
// come from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "node/shading/kernels.h"
#include "node/simd/vectors.h"

namespace mars::shading::MARS_SET {

using namespace simd::MARS_SET;

inline Floats zero() { return hn::Zero(kFloats); }

inline Floats dot(const Floats* a, const Floats* b) {
  return hn::Add(hn::Add(hn::Mul(a[0], b[0]), hn::Mul(a[1], b[1])), hn::Mul(a[2], b[2]));
}

// Whether triangles carry colours instead of normals.
inline bool is_colored(const wire::Material& m) { return m.interpolation != wire::Interpolation::phong; }

// Whether samples of both materials can be in one block.
inline bool share_model(const wire::Material& a, const wire::Material& b) {
  return is_colored(a) ? is_colored(b) : !is_colored(b) && a.reflection == b.reflection;
}

// From sample `first` of a block on, until the next.
struct Stretch {
  std::uint32_t first;
  std::uint32_t material;
};

constexpr std::uint32_t kBlock = 256;
constexpr std::uint32_t kCapacity = kBlock + simd::kVectorSlack;

struct Block {
  alignas(64) float values[kCapacity][shape::kValues];
  // The sample's place is -from * w, w being 1 / its value of depth; so this is where the eye is, if at one place.
  alignas(64) float from[3][kCapacity];
  alignas(64) float facing[kCapacity];  // of one light: N.L
  alignas(64) float square[kCapacity];  // and (R.V)^2 or (N.H)^2; 0 where it is not to be seen
  alignas(64) float bright[kCapacity];  // and how much of it arrives, where that differs
  alignas(64) float color[3][kCapacity];
  Stretch stretches[kBlock];
  std::uint32_t stretch_count = 0;
  std::uint32_t count = 0;
  const bool parallel;  // the eye is towards +z from everywhere

  explicit Block(const Shading& shading) : parallel(shading.projection.parallel) {}

  void clear() { count = stretch_count = 0; }
  void begin_stretch(std::uint32_t at, std::uint32_t material) { stretches[stretch_count++] = {at, material}; }
  bool takes(const wire::Material* materials, std::uint32_t material) const {
    return stretch_count == 0 || share_model(model(materials), materials[material]);
  }
  // One of its materials, all of which share_model.
  const wire::Material& model(const wire::Material* materials) const { return materials[stretches[0].material]; }
  // Samples behind the last, to the end of its vector, are as the last: for what finds places in memory by them.
  void fill_last_vector() {
    for (std::uint32_t k = count; k % kLanes != 0; ++k) {
      std::memcpy(values[k], values[count - 1], sizeof values[k]);
      for (auto& along : from) along[k] = along[count - 1];
    }
  }
  // Samples whose values are as triangles have them in parallel projection get w = 1, and from = -place.
  void place_parallel() {
    for (std::uint32_t k = 0; k < count; k += kLanes) {
      Floats depth, normal[3];
      hn::LoadInterleaved4(kFloats, values[k], depth, normal[0], normal[1], normal[2]);
      hn::Store(hn::Neg(depth), kFloats, from[2] + k);
      hn::StoreInterleaved4(constant(1.0f), normal[0], normal[1], normal[2], kFloats, values[k]);
    }
  }
  // Of the latest stretch, or `none`.
  std::uint32_t last_material(std::uint32_t none) const {
    return stretch_count > 0 ? stretches[stretch_count - 1].material : none;
  }
};

// What the block's samples send to the eye: to Block::color, before exposure.
void shade_to_light(const Shading& shading, Block& block);
// What the samples send there without lights that cast, and without fog and bound.
void shade_base(const Shading& shading, Block& block);
// And what casting light number `casting` adds.
void shade_term(const Shading& shading, std::uint32_t casting, Block& block);
// The bound of light.
float most_light(const Shading& shading);
// What its vertices send there, whose triangles will carry it: no fog, no bound.
void light_vertices(const Shading& shading, Block& block);
// What its samples send there, encoded.
void shade_to_pixels(const Shading& shading, Block& block, std::byte* pixels);

}  // namespace mars::shading::MARS_SET
