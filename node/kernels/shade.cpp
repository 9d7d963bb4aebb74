// Phong's model at the samples that are seen.
#include <cmath>

#include "node/kernels/simd.h"

namespace mars::node::MARS_SET {
namespace {

// Samples of one look that are shaded together: what is interpolated for each.
constexpr int kBatch = 256;
struct Batch {
  alignas(64) float normal[3][kBatch];
  alignas(64) float inverse_w[kBatch];
  alignas(64) float column[kBatch];
  int count = 0;
};

// power[k] = base[k] ^ exponent for bases 0..1, by squarings and square roots; the exponent counts to 1/256.
void raise(float* __restrict base, float* __restrict power, int count, float exponent) {
  const auto fixed = static_cast<std::uint32_t>(exponent * 256.0f + 0.5f);
  alignas(64) float root[kBatch];
  for (int k = 0; k < count; ++k) {
    power[k] = base[k] > 0.0f ? 1.0f : 0.0f;  // no light is none at exponent 0 too
    root[k] = base[k];
  }
  for (std::uint32_t bit = 128; bit != 0 && (fixed & 255) != 0; bit >>= 1) {
    for (int k = 0; k < count; ++k) root[k] = std::sqrt(root[k]);
    if (fixed & bit)
      for (int k = 0; k < count; ++k) power[k] *= root[k];
  }
  for (std::uint32_t whole = fixed >> 8; whole != 0; whole >>= 1) {
    if (whole & 1)
      for (int k = 0; k < count; ++k) power[k] *= base[k];
    if (whole > 1)
      for (int k = 0; k < count; ++k) base[k] *= base[k];
  }
}

// The eye's side of Phong's model for a batch: unit normals, unit directions to the eye.
struct Directions {
  alignas(64) float normal[3][kBatch];
  alignas(64) float eye[3][kBatch];
};

void directions(const Batch& batch, const Projection& p, float line, Directions& out) {
  const float per_pixel = 1.0f / p.scale;
  const float dy = (line + 0.5f - p.center[1]) * per_pixel;
  for (int k = 0; k < batch.count; ++k) {
    const float x = batch.normal[0][k], y = batch.normal[1][k], z = batch.normal[2][k];
    const float square = x * x + y * y + z * z;
    const float scale = square > 0.0f ? 1.0f / std::sqrt(square) : 0.0f;
    out.normal[0][k] = x * scale;
    out.normal[1][k] = y * scale;
    out.normal[2][k] = z * scale;
    const float dx = (batch.column[k] + 0.5f - p.center[0]) * per_pixel;
    const float toward = 1.0f / std::sqrt(dx * dx + dy * dy + 1.0f);
    out.eye[0][k] = -dx * toward;
    out.eye[1][k] = dy * toward;
    out.eye[2][k] = toward;
  }
}

// Unit directions from the batch's places to a point light. The place is (dx, -dy, -1) * w.
void to_point_light(const Batch& batch, const Projection& p, float line, const EyeLight& light, float (*to)[kBatch]) {
  const float per_pixel = 1.0f / p.scale;
  const float dy = (line + 0.5f - p.center[1]) * per_pixel;
  for (int k = 0; k < batch.count; ++k) {
    const float w = 1.0f / batch.inverse_w[k];
    const float dx = (batch.column[k] + 0.5f - p.center[0]) * per_pixel;
    const float x = light.vector[0] - dx * w;
    const float y = light.vector[1] + dy * w;
    const float z = light.vector[2] + w;
    const float square = x * x + y * y + z * z;
    const float scale = square > 0.0f ? 1.0f / std::sqrt(square) : 0.0f;
    to[0][k] = x * scale;
    to[1][k] = y * scale;
    to[2][k] = z * scale;
  }
}

// N.L where the light is in front, and R.V = 2 (N.L)(N.V) - L.V where that is seen, else 0.
void reflect(const Directions& d, const float (*to)[kBatch], int count, float* __restrict facing,
             float* __restrict mirrored) {
  for (int k = 0; k < count; ++k) {
    const float nl = d.normal[0][k] * to[0][k] + d.normal[1][k] * to[1][k] + d.normal[2][k] * to[2][k];
    const float nv = d.normal[0][k] * d.eye[0][k] + d.normal[1][k] * d.eye[1][k] + d.normal[2][k] * d.eye[2][k];
    const float lv = to[0][k] * d.eye[0][k] + to[1][k] * d.eye[1][k] + to[2][k] * d.eye[2][k];
    const float rv = 2.0f * nl * nv - lv;
    facing[k] = nl > 0.0f ? nl : 0.0f;
    mirrored[k] = (nl > 0.0f) & (rv > 0.0f) ? (rv < 1.0f ? rv : 1.0f) : 0.0f;
  }
}

std::uint32_t level(float intensity) {
  const float clamped = intensity > 0.0f ? (intensity < 1.0f ? intensity : 1.0f) : 0.0f;
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(clamped * 255.0f + 0.5f));
}

void shade_batch(const Shading& shading, const Batch& batch, float line, const Material& material,
                 std::uint32_t* __restrict pixels) {
  Directions d;
  alignas(64) float to[3][kBatch], facing[kBatch], mirrored[kBatch], highlight[kBatch], color[3][kBatch];
  directions(batch, shading.projection, line, d);
  const float own[3] = {material.color[0], material.color[1], material.color[2]};
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < batch.count; ++k) color[c][k] = material.ambient * own[c];
  for (std::uint32_t l = 0; l < shading.light_count; ++l) {
    const EyeLight& light = shading.lights[l];
    if (light.point)
      to_point_light(batch, shading.projection, line, light, to);
    else
      for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < batch.count; ++k) to[axis][k] = light.vector[axis];
    reflect(d, to, batch.count, facing, mirrored);
    raise(mirrored, highlight, batch.count, material.exponent);
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < batch.count; ++k)
        color[c][k] += (material.diffuse * own[c] * facing[k] + material.specular * highlight[k]) * light.color[c];
  }
  for (int k = 0; k < batch.count; ++k)
    pixels[k] = level(color[0][k]) | level(color[1][k]) << 8 | level(color[2][k]) << 16;
}

// Adds columns [first, last), all of one triangle, to the batch.
void interpolate(const Triangle& triangle, std::int32_t line, std::int32_t first, std::int32_t last, Batch& batch) {
  const auto dy = static_cast<float>(line * kSubpixels + kSampleOffset - triangle.first_y);
  float on_line[kValues];
  for (int v = 0; v < kValues; ++v) on_line[v] = triangle.at_first[v] + dy * triangle.per_y[v];
  const std::int32_t from_first = kSampleOffset - triangle.first_x;
  const int at = batch.count - first;
  for (std::int32_t column = first; column < last; ++column) {
    const auto dx = static_cast<float>(column * kSubpixels + from_first);
    for (int axis = 0; axis < 3; ++axis)
      batch.normal[axis][at + column] = on_line[kNormalX + axis] + dx * triangle.per_x[kNormalX + axis];
    batch.inverse_w[at + column] = on_line[kDepth] + dx * triangle.per_x[kDepth];
    batch.column[at + column] = static_cast<float>(column);
  }
  batch.count += last - first;
}

}  // namespace

Shaded shade(const Shading& shading, const std::uint32_t* ids, std::uint32_t line, Extent extent, Run* runs,
             std::uint32_t* pixels) {
  const std::uint32_t last = extent.last;
  Shaded done{0, 0};
  Batch batch;
  std::uint32_t look = 0;
  const auto flush = [&] {
    if (batch.count == 0) return;
    shade_batch(shading, batch, static_cast<float>(line), shading.materials[look], pixels + done.pixels);
    done.pixels += static_cast<std::uint32_t>(batch.count);
    batch.count = 0;
  };
  for (std::uint32_t column = extent.first; column < last;) {
    if (ids[column] == kNoTriangle) {
      ++column;
      continue;
    }
    const std::uint32_t run_first = column;
    while (column < last && ids[column] != kNoTriangle) {
      const Triangle& triangle = shading.triangles[ids[column]];
      if (triangle.look != look || batch.count == kBatch) flush();
      look = triangle.look;
      const std::uint32_t room = column + static_cast<std::uint32_t>(kBatch - batch.count);
      const std::uint32_t end = room < last ? room : last;
      const std::uint32_t piece = column;
      while (column < end && ids[column] == ids[piece]) ++column;
      interpolate(triangle, static_cast<std::int32_t>(line), static_cast<std::int32_t>(piece),
                  static_cast<std::int32_t>(column), batch);
    }
    runs[done.runs++] = {line, static_cast<std::uint16_t>(run_first), static_cast<std::uint16_t>(column - run_first)};
  }
  flush();
  return done;
}

}  // namespace mars::node::MARS_SET
