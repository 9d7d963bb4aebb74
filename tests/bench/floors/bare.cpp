#include "tests/bench/floors/bare.h"

#include <cmath>

#define MARS_JOIN2(a, b) a##b
#define MARS_JOIN(a, b) MARS_JOIN2(a, b)

namespace mars::bench {
namespace MARS_SET {
namespace {

std::uint32_t level(float intensity) {
  const float clamped = intensity > 0.0f ? (intensity < 1.0f ? intensity : 1.0f) : 0.0f;
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(clamped * 255.0f + 0.5f));
}

void shade(const Stretch& s, const wire::Material& m, const geometry::EyeLight& light, int count,
           std::uint32_t* __restrict pixels) {
  const float lx = light.vector[0], ly = light.vector[1], lz = light.vector[2];
  for (int k = 0; k < count; ++k) {
    const auto at = static_cast<float>(k);
    const float x = s.normal[0] + at * s.normal_step[0], y = s.normal[1] + at * s.normal_step[1],
                z = s.normal[2] + at * s.normal_step[2];
    const float unit = 1.0f / std::sqrt(x * x + y * y + z * z);
    const float nx = x * unit, ny = y * unit, nz = z * unit;
    const float u = s.eye[0] + at * s.eye_step[0], v = s.eye[1] + at * s.eye_step[1], w = s.eye[2] + at * s.eye_step[2];
    const float toward = 1.0f / std::sqrt(u * u + v * v + w * w);
    const float ex = u * toward, ey = v * toward, ez = w * toward;
    const float nl = nx * lx + ny * ly + nz * lz;
    const float nv = nx * ex + ny * ey + nz * ez;
    const float lv = lx * ex + ly * ey + lz * ez;
    const float rv = 2.0f * nl * nv - lv;
    const float facing = nl > 0.0f ? nl : 0.0f;
    float power = (nl > 0.0f) & (rv > 0.0f) ? (rv < 1.0f ? rv : 1.0f) : 0.0f;
    for (int squaring = 0; squaring < 5; ++squaring) power *= power;
    const float diffuse = m.ambient + m.diffuse * facing, specular = m.specular * power;
    pixels[k] = level(m.color[0] * diffuse + specular) | level(m.color[1] * diffuse + specular) << 8 |
                level(m.color[2] * diffuse + specular) << 16;
  }
}

// Triangles come from all over memory: the kernel fetches them ahead, so does its floor.
constexpr std::ptrdiff_t kAhead = 32;

void write_depths(const geometry::Triangle* triangles, const Piece* pieces, std::size_t count,
                  float* __restrict depth) {
  const Piece* const end = pieces + count;
  for (const Piece* piece = pieces; piece != end; ++piece) {
    __builtin_prefetch(triangles + piece[end - piece > kAhead ? kAhead : 0].triangle);
    const geometry::Triangle& t = triangles[piece->triangle];
    const auto line = static_cast<std::int32_t>(piece->line), last = static_cast<std::int32_t>(piece->last);
    const auto dy = static_cast<float>(line * shape::kSubpixels + shape::kSampleOffset - t.first_y);
    const float on_line = t.at_first[shape::kDepth] + dy * t.per_y[shape::kDepth], per_x = t.per_x[shape::kDepth];
    const std::int32_t from_first = shape::kSampleOffset - t.first_x;
    for (auto column = static_cast<std::int32_t>(piece->first); column < last; ++column)
      depth[column] = on_line + static_cast<float>(column * shape::kSubpixels + from_first) * per_x;
  }
}

void copy_depths(const float* __restrict from, const Piece* pieces, std::size_t count, float* __restrict depth) {
  for (const Piece* piece = pieces; piece != pieces + count; ++piece)
    for (std::uint32_t column = piece->first; column < piece->last; ++column) depth[column] = *from++;
}

}  // namespace
}  // namespace MARS_SET

namespace MARS_SET {
extern const Bare::Shade bare_models[];
}
extern const Bare MARS_JOIN(bare_, MARS_SET);
const Bare MARS_JOIN(bare_, MARS_SET) = {MARS_SET::shade, MARS_SET::bare_models, MARS_SET::write_depths,
                                         MARS_SET::copy_depths};

}  // namespace mars::bench
