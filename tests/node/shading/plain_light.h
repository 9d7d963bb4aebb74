// The light that a surface sends to the eye, plainly written in double precision from the formulas' sources: the twin
// of node/shading/kernels.
#pragma once

#include "node/shading/shading.h"
#include "tests/node/shape/patches.h"

namespace mars::shading {

// In eye space; the normal has length 1, or 0 where there is none.
struct Spot {
  shape::Vec3 place;
  shape::Vec3 normal;
};

// N, L and V of length 1. pi x reflectance x N.L of a surface that L and V are both before.
shape::Vec3 plain_reflection(const wire::Material& material, const shape::Vec3& n, const shape::Vec3& l,
                             const shape::Vec3& v);

// 0..1 of the light's colour.
double plain_brightness(const geometry::EyeLight& light, const shape::Vec3& place);

// Of all lights and from all around, without fog.
shape::Vec3 plain_light(const Shading& shading, const wire::Material& material, const Spot& spot);

shape::Vec3 plain_fog(const wire::Fog& fog, const shape::Vec3& light, double w);

}  // namespace mars::shading
