// The inner loops of encoding, inline for the kernels that make light. Step by step what pixel_of does (encoding.cpp).
#pragma once

#include <cstdint>

#include "node/color/kernels/functions.h"

namespace mars::color::MARS_SET {

namespace vectors = simd::MARS_SET;
namespace hn = vectors::hn;
using vectors::constant;
using vectors::Floats;
using vectors::Ints;
using vectors::kFloats;
using vectors::kInts;
using vectors::kLanes;

inline Ints whole(std::uint32_t number) { return hn::Set(kInts, static_cast<std::int32_t>(number)); }

inline void apply_filmic_curve(Floats* color) {
  const Floats brightest = hn::Max(color[0], hn::Max(color[1], color[2]));
  const Floats one = constant(1.0f), rest = constant(1.0f - kShoulder), shoulder = constant(kShoulder);
  const auto bright = hn::Gt(brightest, shoulder);
  if (hn::AllFalse(kFloats, bright)) return;
  const Floats beyond = hn::Sub(hn::Add(hn::Max(brightest, shoulder), rest), shoulder);
  const Floats shown = hn::Sub(one, hn::Div(hn::Mul(rest, rest), beyond));
  const Floats scale = hn::Div(shown, hn::Max(brightest, shoulder));
  const Floats kept = hn::Div(one, hn::Add(hn::Mul(constant(kBleach), hn::Sub(brightest, shown)), one));
  for (int c = 0; c < 3; ++c) {
    const Floats curved = hn::Add(hn::Mul(hn::Sub(hn::Mul(color[c], scale), shown), kept), shown);
    color[c] = hn::IfThenElse(bright, curved, color[c]);
  }
}

inline void mix(const float (&rows)[3][3], Floats* color) {
  Floats out[3];
  for (int c = 0; c < 3; ++c)
    out[c] = hn::Add(hn::Add(hn::Mul(constant(rows[c][0]), color[0]), hn::Mul(constant(rows[c][1]), color[1])),
                     hn::Mul(constant(rows[c][2]), color[2]));
  for (int c = 0; c < 3; ++c) color[c] = out[c];
}

// Between the entries from `place` on.
inline Floats between(const float* table, Ints place, Floats part) {
  const Floats entry = hn::GatherIndex(kFloats, table, place);
  return hn::Add(entry, hn::Mul(hn::Sub(hn::GatherIndex(kFloats, table + 1, place), entry), part));
}

inline Floats agx_curve(const AgxTables& tables, Floats light) {
  const Floats cut = hn::Min(hn::Max(light, constant(kAgxDarkest)), constant(kAgxBrightest));
  const Ints beyond = hn::Sub(hn::BitCast(kInts, cut), hn::BitCast(kInts, constant(kAgxDarkest)));
  const Ints part = hn::And(beyond, whole((1u << kAgxEntryBits) - 1));
  return between(tables.curve, hn::ShiftRight<kAgxEntryBits>(beyond),
                 hn::Mul(hn::ConvertTo(kFloats, part), constant(1.0f / (1 << kAgxEntryBits))));
}

inline Floats agx_power(const AgxTables& tables, Floats value) {
  const Floats cut = hn::Min(hn::Max(value, hn::Zero(kFloats)), constant(1.0f));
  const Floats step = hn::Mul(cut, constant(float{kAgxSteps}));
  const Ints place = hn::ConvertTo(kInts, step);
  return between(tables.power, place, hn::Sub(step, hn::ConvertTo(kFloats, place)));
}

inline void apply_agx(const AgxTables& tables, Floats* color) {
  mix(kAgxInset, color);
  for (int c = 0; c < 3; ++c) color[c] = agx_curve(tables, color[c]);
  mix(kAgxOutset, color);
  for (int c = 0; c < 3; ++c) color[c] = agx_power(tables, color[c]);
}

// Black beyond `count`: what lies there was never written, and shall choose no branch of the curve and no place in a
// table.
inline void load(const float* const* light, std::uint32_t at, std::uint32_t count, Floats* color) {
  for (int c = 0; c < 3; ++c) color[c] = hn::LoadU(kFloats, light[c] + at);
  if (count - at >= kLanes) return;
  const auto lit = hn::FirstN(kFloats, count - at);
  for (int c = 0; c < 3; ++c) color[c] = hn::IfThenElseZero(lit, color[c]);
}

// Light that the film is to show, 0..1.
template <wire::ColorSpace kSpace>
void show(const Encoding& encoding, Floats* color) {
  if constexpr (kSpace == wire::ColorSpace::linear) {
    for (int c = 0; c < 3; ++c)
      color[c] = hn::Min(hn::Mul(color[c], constant(encoding.exposure)), constant(kMostExposed));
    if (encoding.curve == wire::Curve::filmic) apply_filmic_curve(color);
    if (encoding.curve == wire::Curve::agx) apply_agx(encoding.agx, color);
  }
  for (int c = 0; c < 3; ++c) color[c] = hn::Min(hn::Max(color[c], hn::Zero(kFloats)), constant(1.0f));
}

inline Ints nearest(Floats value) { return hn::ConvertTo(kInts, hn::Add(value, constant(0.5f))); }

// Its level of 0..most, or where it stands in the table of `steps` steps.
template <wire::ColorSpace kSpace>
Ints place(Floats shown, float most, float steps) {
  if constexpr (kSpace == wire::ColorSpace::coded) return nearest(hn::Mul(shown, constant(most)));
  return nearest(hn::Mul(hn::Sqrt(shown), constant(steps)));
}

// Each of a vector's places becomes the level that stands there.
inline void look_up(const std::int32_t* table, Ints* places) {
  for (int c = 0; c < 3; ++c) places[c] = hn::GatherIndex(kInts, table, places[c]);
}

inline void store8(const Ints* level, std::uint32_t at, void* pixels) {
  const Ints pixel = hn::Or(hn::Or(level[0], hn::ShiftLeft<8>(level[1])), hn::ShiftLeft<16>(level[2]));
  hn::StoreU(pixel, kInts, static_cast<std::int32_t*>(pixels) + at);
}

inline void store16(const Ints* level, std::uint32_t at, void* pixels) {
  const Ints red_and_green = hn::Or(level[0], hn::ShiftLeft<16>(level[1]));
  hn::StoreInterleaved2(red_and_green, level[2], kInts, static_cast<std::int32_t*>(pixels) + 2 * at);
}

// `kWide`: levels of 16 bits, else of 8.
template <wire::ColorSpace kSpace, bool kWide>
void encode_levels(const Encoding& encoding, const float* const* light, std::uint32_t count, void* pixels) {
  constexpr float kMost = kWide ? 65535.0f : 255.0f, kSteps = kWide ? kSteps16 : kSteps8;
  for (std::uint32_t k = 0; k < count; k += kLanes) {
    Floats color[3];
    load(light, k, count, color);
    show<kSpace>(encoding, color);
    Ints level[3];
    for (int c = 0; c < 3; ++c) level[c] = place<kSpace>(color[c], kMost, kSteps);
    if constexpr (kSpace == wire::ColorSpace::linear) look_up(kWide ? encoding.srgb16 : encoding.srgb8, level);
    (kWide ? store16 : store8)(level, k, pixels);
  }
}

// By whole numbers, for not all instruction sets have such conversions, or the same. Below 2^-14 halves are 2^-24
// apart, as floats between 0.5 and 1 are.
inline Ints half_of(Floats value) {
  const Floats cut = hn::Min(value, constant(kMostHalf));
  const Ints small = hn::Sub(hn::BitCast(kInts, hn::Add(cut, constant(0.5f))), hn::BitCast(kInts, constant(0.5f)));
  const Ints bits = hn::Sub(hn::BitCast(kInts, cut), whole(112u << 23));
  const Ints odd = hn::And(hn::ShiftRight<13>(bits), whole(1));
  const Ints normal = hn::ShiftRight<13>(hn::Add(hn::Add(bits, whole(0xfff)), odd));
  return hn::IfThenElse(hn::RebindMask(kInts, hn::Lt(cut, constant(0x1p-14f))), small, normal);
}

inline void encode_halves(const float* const* light, std::uint32_t count, void* pixels) {
  for (std::uint32_t k = 0; k < count; k += kLanes) {
    Floats color[3];
    load(light, k, count, color);
    const Ints level[3] = {half_of(color[0]), half_of(color[1]), half_of(color[2])};
    store16(level, k, pixels);
  }
}

// ColorKernels::encode.
inline void encode_planes(const Encoding& encoding, const float* const* light, std::uint32_t count, void* pixels) {
  using wire::ColorSpace, wire::PixelFormat;
  const bool linear = encoding.space == ColorSpace::linear;
  const auto encode8 = linear ? encode_levels<ColorSpace::linear, false> : encode_levels<ColorSpace::coded, false>;
  const auto encode16 = linear ? encode_levels<ColorSpace::linear, true> : encode_levels<ColorSpace::coded, true>;
  switch (encoding.format) {
    case PixelFormat::rgb8: return encode8(encoding, light, count, pixels);
    case PixelFormat::rgb16: return encode16(encoding, light, count, pixels);
    default: return encode_halves(light, count, pixels);
  }
}

}  // namespace mars::color::MARS_SET
