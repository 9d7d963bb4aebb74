// Light of samples where lights cast shadows: what each casting light would add is kept apart, and summed up once it is
// known how much of it arrives.
#include "node/shading/kernels/block.h"
#include "node/shading/kernels/fog.h"
#include "node/shading/kernels/fragments.h"
#include "node/shading/kernels/functions.h"
#include "node/shading/kernels/lights.h"

namespace mars::shading::MARS_SET {

namespace {

// The planes of a block's triangles: normals, of any length, turned to the eye.
struct Planes {
  alignas(64) float normal[3][kCapacity];
};

// Of the plane 1 = k w + b x + c y, by 1 / w = k + (b x + c y) / w on the screen; in parallel projection of the plane
// -w = k + b x + c y.
void add_planes(const Shading& shading, const Fragment* fragments, std::uint32_t count, Planes& out) {
  const shape::Projection& p = shading.projection;
  const float across = p.scale * p.squeeze * shape::kSubpixels, up = p.scale * shape::kSubpixels;
  for (std::uint32_t k = 0; k < count; ++k) {
    const geometry::Triangle& t = shading.triangles[fragments[k].triangle];
    const float per_x = t.per_x[shape::kDepth], per_y = t.per_y[shape::kDepth];
    const float dy = p.center[1] * shape::kSubpixels - static_cast<float>(t.first_y + p.origin[1] * shape::kSubpixels);
    const float dx = p.center[0] * shape::kSubpixels - static_cast<float>(t.first_x + p.origin[0] * shape::kSubpixels);
    out.normal[0][k] = -(per_x * across);
    out.normal[1][k] = per_y * up;
    out.normal[2][k] = p.parallel ? 1.0f : (t.at_first[shape::kDepth] + dy * per_y) + dx * per_x;
  }
}

// 0..1: how much of a light a triangle shows that is turned away from it further than its interpolated normals are.
// With cosines g of plane and light, s of normal and light, d of plane and normal, x = g / (s d) is 1 where they agree
// and falls to 0 where the plane is edge-on; x + x^2 - x^3 does so without a break at 1 (M. J.-Y. Chiang et al.,
// "Taming the shadow terminator", 2019). Triangles whose normals are no normals of theirs keep all.
Floats terminator(const Surfaces& s, const Rays& r, const Floats* plane) {
  const Floats one = constant(1.0f), least = constant(1.0f / 16);
  const Floats gt = dot(plane, r.t), gn = dot(plane, s.n), gg = dot(plane, plane);
  const Floats x = between_0_and_1(hn::Div(hn::Mul(gt, s.nn), hn::Mul(r.nt, gn)));
  const Floats square = hn::Mul(x, x);
  const Floats smooth = hn::Sub(hn::Add(x, square), hn::Mul(square, x));
  const auto agree = hn::And(hn::Gt(gn, zero()), hn::Gt(hn::Mul(gn, gn), hn::Mul(least, hn::Mul(gg, s.nn))));
  return hn::IfThenElse(agree, smooth, one);
}

void dim(const geometry::EyeLight& from, const Planes& planes, Block& block) {
  const Light light(from);
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    const Surfaces surfaces(block, k);
    const Floats plane[3] = {hn::Load(kFloats, planes.normal[0] + k), hn::Load(kFloats, planes.normal[1] + k),
                             hn::Load(kFloats, planes.normal[2] + k)};
    const Floats share = terminator(surfaces, light.rays(surfaces), plane);
    for (auto& color : block.color)
      hn::Store(hn::Max(hn::Mul(share, hn::Load(kFloats, color + k)), zero()), kFloats, color + k);
  }
}

void copy_out(const Block& block, std::uint32_t at, float* const* to) {
  for (int c = 0; c < 3; ++c)
    for (std::uint32_t k = 0; k < block.count; k += kLanes)
      hn::StoreU(hn::Load(kFloats, block.color[c] + k), kFloats, to[c] + at + k);
}

void share_fog(const wire::Fog& fog, const Block& block, float* out) {
  const FogDepth depth(fog);
  for (std::uint32_t k = 0; k < block.count; k += kLanes) hn::StoreU(depth.share(block, k), kFloats, out + k);
}

}  // namespace

ShadedCounts shade_unsummed(const Shading& shading, const Fragment* fragments, std::uint32_t count, std::uint32_t line,
                            const UnsummedLight& out) {
  ShadedCounts counts;
  Block block(shading);
  Planes planes;
  const geometry::EyeLight* const casting = shading.lights + (shading.light_count - shading.casting_count);
  for (std::uint32_t done = 0; done < count; done += block.count) {
    block.clear();
    add_fragments(shading, fragments + done, count - done, line, block);
    add_planes(shading, fragments + done, block.count, planes);
    shade_base(shading, block);
    copy_out(block, done, out.base);
    for (std::uint32_t l = 0; l < shading.casting_count; ++l) {
      shade_term(shading, l, block);
      dim(casting[l], planes, block);
      copy_out(block, done, out.terms + 3 * l);
    }
    if (is_foggy(shading.fog)) share_fog(shading.fog, block, out.fog + done);
    counts += counts_of(shading, block);
  }
  return counts;
}

void sum_up(const Shading& shading, const UnsummedLight& in, const float* const* shares, std::uint32_t count,
            float* const* light) {
  const Floats most = constant(most_light(shading));
  for (std::uint32_t k = 0; k < count; k += kLanes)
    for (std::size_t c = 0; c < 3; ++c) {
      Floats color = hn::LoadU(kFloats, in.base[c] + k);
      for (std::size_t l = 0; l < shading.casting_count; ++l)
        color = hn::Add(color, hn::Mul(hn::LoadU(kFloats, in.terms[3 * l + c] + k), hn::LoadU(kFloats, shares[l] + k)));
      if (is_foggy(shading.fog)) {
        const Floats more = hn::Sub(constant(shading.fog.color[c]), color);
        color = hn::Add(color, hn::Mul(hn::LoadU(kFloats, in.fog + k), more));
      }
      hn::StoreU(hn::Min(hn::Max(color, zero()), most), kFloats, light[c] + k);
    }
}

}  // namespace mars::shading::MARS_SET
