// A light as shading takes it. A plain struct: kernels of several instruction sets share it.
#pragma once

#include "node/wire/film_parts.h"

namespace mars::geometry {

struct EyeLight {
  wire::LightKind kind;
  float vector[3];  // eye space: the light's place, or the unit direction to it
  float color[3];
  float axis[3];    // of a spot, in eye space
  float cos_inner;  // this and what follows: as in wire::Light
  float cos_outer;
  float reach;
};

}  // namespace mars::geometry
