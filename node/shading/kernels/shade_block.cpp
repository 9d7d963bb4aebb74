// The light that a block's samples send to the eye: that from all around, then light after light, a whole vector of
// samples at a time, then fog. Each block has one reflection model.
#include <cstddef>
#include <cstdint>

#include "node/color/kernels/encode.h"
#include "node/shading/kernels/ambient.h"
#include "node/shading/kernels/blinn_phong.h"
#include "node/shading/kernels/block.h"
#include "node/shading/kernels/cook_torrance.h"
#include "node/shading/kernels/fog.h"
#include "node/shading/kernels/lights.h"
#include "node/shading/kernels/metallic_roughness.h"
#include "node/shading/kernels/phong.h"

namespace mars::shading::MARS_SET {

namespace {

constexpr float kMostLevel = 255;

// The nearest whole number of 0..255 in the lowest bits, others above them: sums of 2^23 and less have no fraction.
Ints level(Floats color) {
  const Floats clamped = hn::Min(hn::Max(color, zero()), constant(kMostLevel));
  return hn::BitCast(kInts, hn::Add(clamped, constant(8388608.0f)));
}

void pack(const Floats* color, std::uint32_t* pixels) {
  const Ints red = hn::And(level(color[0]), hn::Set(kInts, 255));
  const Ints green = hn::And(hn::ShiftLeft<8>(level(color[1])), hn::Set(kInts, 255 << 8));
  const Ints pixel = hn::Or(hn::Or(red, green), hn::ShiftLeft<16>(level(color[2])));
  hn::StoreU(pixel, kInts, reinterpret_cast<std::int32_t*>(pixels));
}

void load(const Block& block, std::uint32_t k, Floats* color) {
  for (int c = 0; c < 3; ++c) color[c] = hn::Load(kFloats, block.color[c] + k);
}

void store(const Floats* color, std::uint32_t k, Block& block) {
  for (int c = 0; c < 3; ++c) hn::Store(color[c], kFloats, block.color[c] + k);
}

template <typename Lanes>
void begin_with_ambient(const Shading& shading, const Scale& scale, Block& block) {
  const Hemisphere hemisphere(shading);
  Materials<Lanes> materials(shading.materials, scale, block);
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    materials.move_to(k);
    Floats color[3];
    reflect_ambient(hemisphere, Surfaces(block, k), materials.lanes(), color);
    store(color, k, block);
  }
}

// Fills facing, square and, where the light fades, bright for one light.
template <typename Highlight, bool kFades>
void face(const Light& light, Block& block) {
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    const Surfaces surfaces(block, k);
    const Rays rays = light.rays(surfaces);
    hn::Store(rays.facing(), kFloats, block.facing + k);
    hn::Store(Highlight::square(surfaces, rays), kFloats, block.square + k);
    if constexpr (kFades) hn::Store(light.brightness(surfaces, rays), kFloats, block.bright + k);
  }
}

// Adds one light to the block's colours, or to the ambient ones of its materials if it is the first. If there are
// `pixels`, colours are levels that are packed.
template <bool kFades>
void add_light(const Shading& shading, const Scale& scale, const Light& light, bool first, Block& block,
               std::uint32_t* pixels) {
  Materials<HighlightLanes> materials(shading.materials, scale, block);
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    materials.move_to(k);
    const HighlightLanes& lanes = materials.lanes();
    const Floats facing = hn::Load(kFloats, block.facing + k), square = hn::Load(kFloats, block.square + k);
    const Floats power = materials.each([](const wire::Material& m) { return m.exponent; },
                                        [square](float exponent) { return raise(square, exponent); });
    const Floats mirrored = hn::Mul(lanes.specular, power);
    Floats color[3];
    for (int c = 0; c < 3; ++c) {
      const Floats before = first ? lanes.ambient[c] : hn::Load(kFloats, block.color[c] + k);
      Floats shines = light.color()[c];
      if constexpr (kFades) shines = hn::Mul(shines, hn::Load(kFloats, block.bright + k));
      color[c] = hn::Add(before, hn::Mul(hn::Add(hn::Mul(lanes.diffuse[c], facing), mirrored), shines));
    }
    if (pixels)
      pack(color, pixels + k);
    else
      store(color, k, block);
  }
}

template <typename Highlight, bool kFades>
void shade_light(const Shading& shading, const Scale& scale, const Light& light, bool first, Block& block,
                 std::uint32_t* pixels) {
  face<Highlight, kFades>(light, block);
  add_light<kFades>(shading, scale, light, first, block, pixels);
}

// Phong's and Blinn's models. If there are `pixels`, the last light packs them.
template <typename Highlight>
void shade_highlights(const Shading& shading, const Scale& scale, Block& block, std::uint32_t* pixels) {
  const bool even = is_even(shading.ambient);
  if (!even) begin_with_ambient<HighlightLanes>(shading, scale, block);
  const geometry::EyeLight dark{};
  const geometry::EyeLight* lights = shading.light_count > 0 ? shading.lights : &dark;
  const std::uint32_t count = shading.light_count > 0 ? shading.light_count : 1;
  for (std::uint32_t l = 0; l < count; ++l) {
    const Light light(lights[l]);
    const auto shade = light.fades() ? shade_light<Highlight, true> : shade_light<Highlight, false>;
    shade(shading, scale, light, even && l == 0, block, l + 1 == count ? pixels : nullptr);
  }
}

// Models of rough surfaces, which are functions of Cosines.
template <typename Lanes>
void shade_facets(const Shading& shading, const Scale& scale, Block& block) {
  begin_with_ambient<Lanes>(shading, scale, block);
  for (std::uint32_t l = 0; l < shading.light_count; ++l) {
    const Light light(shading.lights[l]);
    Materials<Lanes> materials(shading.materials, scale, block);
    for (std::uint32_t k = 0; k < block.count; k += kLanes) {
      materials.move_to(k);
      const Surfaces surfaces(block, k);
      const Rays rays = light.rays(surfaces);
      const Floats bright = light.brightness(surfaces, rays);
      Floats reflected[3], color[3];
      materials.lanes().reflect(Cosines(surfaces, rays), reflected);
      load(block, k, color);
      for (int c = 0; c < 3; ++c) {
        const Floats more = hn::Mul(reflected[c], hn::Mul(light.color()[c], bright));
        color[c] = hn::Add(color[c], hn::IfThenElseZero(rays.front, more));
      }
      store(color, k, block);
    }
  }
}

// Triangles that carry their colour / w in place of their normal's.
void take_colors(float unit, Block& block) {
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    Floats inverse_w, color[3];
    hn::LoadInterleaved4(kFloats, block.values[k], inverse_w, color[0], color[1], color[2]);
    const Floats w = hn::Div(constant(unit), inverse_w);
    for (Floats& channel : color) channel = hn::Mul(channel, w);
    store(color, k, block);
  }
}

void shade_lights(const Shading& shading, float unit, Block& block, std::uint32_t* pixels) {
  Scale scale{unit, {1, 1, 1}};
  if (is_even(shading.ambient))
    for (std::size_t c = 0; c < 3; ++c) scale.ambient[c] = shading.ambient.sky[c];
  switch (block.model(shading.materials).reflection) {
    case wire::Reflection::phong: return shade_highlights<Phong>(shading, scale, block, pixels);
    case wire::Reflection::blinn_phong: return shade_highlights<BlinnPhong>(shading, scale, block, pixels);
    case wire::Reflection::cook_torrance: return shade_facets<CookTorrance>(shading, scale, block);
    case wire::Reflection::metallic_roughness:
      block.fill_last_vector();  // its ambient light is looked up in tables
      return shade_facets<MetallicRoughness>(shading, scale, block);
  }
}

void shade_samples(const Shading& shading, float unit, Block& block) {
  if (is_colored(block.model(shading.materials)))
    take_colors(unit, block);
  else
    shade_lights(shading, unit, block, nullptr);
  if (is_foggy(shading.fog)) add_fog(shading.fog, unit, block);
}

// A maximum of a number and what is none is the second of the two.
void limit(float most, Block& block) {
  for (auto& color : block.color)
    for (std::uint32_t k = 0; k < block.count; k += kLanes)
      hn::Store(hn::Min(hn::Max(hn::Load(kFloats, color + k), zero()), constant(most)), kFloats, color + k);
}

// Levels, where nothing comes between them and light.
void shade_to_levels(const Shading& shading, Block& block, std::uint32_t* pixels) {
  const wire::Material& model = block.model(shading.materials);
  const bool highlight =
      model.reflection == wire::Reflection::phong || model.reflection == wire::Reflection::blinn_phong;
  if (highlight && !is_colored(model) && !is_foggy(shading.fog))
    return shade_lights(shading, kMostLevel, block, pixels);
  shade_samples(shading, kMostLevel, block);
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    Floats color[3];
    load(block, k, color);
    pack(color, pixels + k);
  }
}

}  // namespace

float most_light(const Shading& shading) {
  return shading.encoding.space == wire::ColorSpace::coded ? 1.0f : kMostShaded;
}

void shade_to_light(const Shading& shading, Block& block) {
  shade_samples(shading, 1, block);
  limit(most_light(shading), block);
}

void shade_base(const Shading& shading, Block& block) {
  Shading base = shading;
  base.light_count -= shading.casting_count;
  if (is_colored(block.model(shading.materials)))
    take_colors(1, block);
  else
    shade_lights(base, 1, block, nullptr);
}

// As if it were the only light.
void shade_term(const Shading& shading, std::uint32_t casting, Block& block) {
  Shading one = shading;
  one.lights += shading.light_count - shading.casting_count + casting;
  one.light_count = 1;
  one.ambient = {{0, 0, 0}, {0, 0, 0}};
  if (!is_colored(block.model(shading.materials))) return shade_lights(one, 1, block, nullptr);
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    const Floats none[3] = {zero(), zero(), zero()};
    store(none, k, block);
  }
}

void light_vertices(const Shading& shading, Block& block) {
  shade_lights(shading, 1, block, nullptr);
  limit(kMostShaded, block);
}

void shade_to_pixels(const Shading& shading, Block& block, std::byte* pixels) {
  const color::Encoding& encoding = shading.encoding;
  if (encoding.space == wire::ColorSpace::coded && encoding.format == wire::PixelFormat::rgb8)
    return shade_to_levels(shading, block, reinterpret_cast<std::uint32_t*>(pixels));
  shade_to_light(shading, block);
  const float* const light[3] = {block.color[0], block.color[1], block.color[2]};
  color::MARS_SET::encode_planes(encoding, light, block.count, pixels);
}

}  // namespace mars::shading::MARS_SET
