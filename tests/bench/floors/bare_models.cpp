// The bare loops of reflection models other than Phong's.
#include <bit>
#include <cmath>

#include "tests/bench/floors/bare.h"

// A loop that calls becomes no vectors.
#define MARS_INLINE [[gnu::always_inline]] inline

namespace mars::bench::MARS_SET {
namespace {

// Of one sample: N.L, N.V and L.V, all of length 1.
struct Angles {
  float nl, nv, lv;
};

MARS_INLINE float at_most(float value, float most) { return value < most ? value : most; }

MARS_INLINE std::uint32_t level(float intensity) {
  const float clamped = intensity > 0.0f ? (intensity < 1.0f ? intensity : 1.0f) : 0.0f;
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(clamped * 255.0f + 0.5f));
}

// e^-x by the nearest power of 2 and a polynomial.
MARS_INLINE float exp_of_minus(float x) {
  const auto k = static_cast<std::int32_t>(x * 1.44269504f + 0.5f);
  const float y = static_cast<float>(k) * 0.693147181f - x;
  const float sum = 1 + y * (1 + y * (0.5f + y * (1.0f / 6 + y * (1.0f / 24 + y * (1.0f / 120 + y * (1.0f / 720))))));
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(sum) - k * (1 << 23));
}

struct Blinn {
  MARS_INLINE static float white(const wire::Material& m, const Angles& a) {
    const float nh = a.nl + a.nv;
    float power = nh * nh / (2.000001f + 2 * a.lv);
    for (int squaring = 0; squaring < 4; ++squaring) power *= power;
    return m.specular * power;
  }
};

struct CookTorrance {
  MARS_INLINE static float white(const wire::Material& m, const Angles& a) {
    const float nv = std::abs(a.nv) + 1e-4f, hh = (2.000001f + 2 * a.lv), length = std::sqrt(hh);
    const float nh = (std::abs(a.nl) + nv) / length, vh = 0.5f * length, square = nh * nh;
    const float per_mm = 1 / (m.roughness * m.roughness), index = m.refraction * m.refraction - 1;
    const float d = exp_of_minus((1 - square) / square * per_mm) / (square * square) * per_mm;
    const float groove = 2 * nh / vh, g = at_most(groove * a.nl / nv, groove);
    const float root = std::sqrt(index + vh * vh), sum = root + vh, less = root - vh;
    const float one = less / sum, other = (vh * sum - 1) / (vh * less + 1);
    return m.specular * 0.125f * d * g * one * one * (1 + other * other);
  }
};

struct MetallicRoughness {
  // Of each channel: F is the material's colour's.
  MARS_INLINE static float light(const wire::Material& m, float color, const Angles& a) {
    const float nv = std::abs(a.nv) + 1e-4f, nl = std::abs(a.nl) + 1e-4f, hh = (2.000001f + 2 * a.lv);
    const float length = std::sqrt(hh), nh = (nl + nv) / length, rest = 1 - 0.5f * length;
    const float alpha = m.roughness * m.roughness, alpha2 = alpha * alpha, below = nh * nh * (alpha2 - 1) + 1;
    const float visible =
        0.5f / (nl * std::sqrt(nv * nv * (1 - alpha2) + alpha2) + nv * std::sqrt(nl * nl * (1 - alpha2) + alpha2));
    const float f0 = 0.04f + m.metallic * (color - 0.04f), f = f0 + (1 - f0) * rest * rest * rest * rest * rest;
    return nl * ((1 - f) * color * (1 - m.metallic) + f * alpha2 / (below * below) * visible);
  }
};

MARS_INLINE Angles angles(const Stretch& s, const geometry::EyeLight& light, float at) {
  const float x = s.normal[0] + at * s.normal_step[0], y = s.normal[1] + at * s.normal_step[1],
              z = s.normal[2] + at * s.normal_step[2];
  const float u = s.eye[0] + at * s.eye_step[0], v = s.eye[1] + at * s.eye_step[1], w = s.eye[2] + at * s.eye_step[2];
  const float unit = 1.0f / std::sqrt(x * x + y * y + z * z), toward = 1.0f / std::sqrt(u * u + v * v + w * w);
  const float* l = light.vector;
  return {(x * l[0] + y * l[1] + z * l[2]) * unit, (x * u + y * v + z * w) * unit * toward,
          (u * l[0] + v * l[1] + w * l[2]) * toward};
}

template <typename Model>
void shade_white(const Stretch& s, const wire::Material& m, const geometry::EyeLight& light, int count,
                 std::uint32_t* __restrict pixels) {
  for (int k = 0; k < count; ++k) {
    const Angles a = angles(s, light, static_cast<float>(k));
    const float white = Model::white(m, a), facing = 0.5f * (a.nl + std::abs(a.nl));
    const float diffuse = m.ambient + m.diffuse * facing;
    pixels[k] = level(m.color[0] * diffuse + white) | level(m.color[1] * diffuse + white) << 8 |
                level(m.color[2] * diffuse + white) << 16;
  }
}

void shade_metallic(const Stretch& s, const wire::Material& m, const geometry::EyeLight& light, int count,
                    std::uint32_t* __restrict pixels) {
  for (int k = 0; k < count; ++k) {
    const Angles a = angles(s, light, static_cast<float>(k));
    float color[3];
    for (std::size_t c = 0; c < 3; ++c) color[c] = m.ambient * m.color[c] + MetallicRoughness::light(m, m.color[c], a);
    pixels[k] = level(color[0]) | level(color[1]) << 8 | level(color[2]) << 16;
  }
}

// Colours that triangles carry / w: as many planes as a normal has, and a division.
void take_colors(const Stretch& s, const wire::Material&, const geometry::EyeLight&, int count,
                 std::uint32_t* __restrict pixels) {
  for (int k = 0; k < count; ++k) {
    const auto at = static_cast<float>(k);
    const float w = 1.0f / (s.eye[2] + at * s.eye_step[0]);
    pixels[k] = level((s.normal[0] + at * s.normal_step[0]) * w) |
                level((s.normal[1] + at * s.normal_step[1]) * w) << 8 |
                level((s.normal[2] + at * s.normal_step[2]) * w) << 16;
  }
}

}  // namespace

extern const Bare::Shade bare_models[];
const Bare::Shade bare_models[] = {shade_white<Blinn>, shade_white<CookTorrance>, shade_metallic, take_colors};

}  // namespace mars::bench::MARS_SET
