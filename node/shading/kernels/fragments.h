// Fragments become a block's samples: their values are interpolated.
#pragma once

#include "node/shading/kernels/block.h"

namespace mars::shading::MARS_SET {

// All values of one sample and what they are computed from: four lanes in one register, with any instruction set;
// arithmetic is lane by lane.
typedef float Sample __attribute__((vector_size(sizeof(float) * shape::kValues)));
typedef std::int32_t Places __attribute__((vector_size(sizeof(std::int32_t) * shape::kValues)));

inline Sample load(const float* values) {
  Sample out;
  std::memcpy(&out, values, sizeof out);
  return out;
}

// The triangle's values at `place`, in 1/256 pixel.
inline void evaluate(const geometry::Triangle& t, Places place, float* values) {
  Places first;
  std::memcpy(&first, &t.first_x, sizeof first);
  const Sample from_first = __builtin_convertvector(place - first, Sample);
  const Sample here = (load(t.at_first) + from_first[1] * load(t.per_y)) + from_first[0] * load(t.per_x);
  std::memcpy(values, &here, sizeof here);
}

// Fills Block::from by places on the picture that is drawn, 1/256 pixel; where the eye is at one place, its z is 1.
inline void set_places(const shape::Projection& p, const std::int32_t (*place)[kCapacity], Block& block) {
  const Floats per_pixel = constant(1.0f / p.scale), across_pixel = constant(1.0f / (p.scale * p.squeeze));
  const Ints left = hn::Set(kInts, p.origin[0] * shape::kSubpixels),
             top = hn::Set(kInts, p.origin[1] * shape::kSubpixels);
  const Floats pixel = constant(1.0f / shape::kSubpixels);
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    const Floats x = hn::Mul(hn::ConvertTo(kFloats, hn::Add(hn::Load(kInts, place[0] + k), left)), pixel);
    const Floats y = hn::Mul(hn::ConvertTo(kFloats, hn::Add(hn::Load(kInts, place[1] + k), top)), pixel);
    hn::Store(hn::Mul(hn::Sub(constant(p.center[0]), x), across_pixel), kFloats, block.from[0] + k);
    hn::Store(hn::Mul(hn::Sub(y, constant(p.center[1])), per_pixel), kFloats, block.from[1] + k);
    hn::Store(constant(1.0f), kFloats, block.from[2] + k);
  }
  if (block.parallel) block.place_parallel();
}

// Puts up to `count` fragments of line `line` into the block, as many as fit and share its model.
inline void add_fragments(const Shading& shading, const Fragment* fragments, std::uint32_t count, std::uint32_t line,
                          Block& block) {
  alignas(64) std::int32_t place[2][kCapacity];
  std::uint32_t k = 0;
  for (; k < count && k < kBlock; ++k) {
    const Fragment& fragment = fragments[k];
    const geometry::Triangle& t = shading.triangles[fragment.triangle];
    const std::int32_t x = fragment.column * shape::kSubpixels + shading.pattern.x[fragment.sample];
    const std::int32_t y = static_cast<std::int32_t>(line) * shape::kSubpixels + shading.pattern.y[fragment.sample];
    if (k == 0 || t.material != block.last_material(0)) {
      if (!block.takes(shading.materials, t.material)) break;
      block.begin_stretch(k, t.material);
    }
    evaluate(t, Places{x, y, 0, 0}, block.values[k]);
    place[0][k] = x;
    place[1][k] = y;
  }
  block.count = k;
  set_places(shading.projection, place, block);
}

inline ShadedCounts counts_of(const Shading& shading, const Block& block) {
  const wire::Material& model = block.model(shading.materials);
  const bool highlight =
      model.reflection == wire::Reflection::phong || model.reflection == wire::Reflection::blinn_phong;
  if (is_colored(model)) return {block.count, 0, 0};
  return {block.count, highlight ? block.count : 0, highlight ? 0 : block.count};
}

}  // namespace mars::shading::MARS_SET
