// A light as shading takes it. A plain struct: kernels of several instruction sets share it.
#pragma once

namespace mars::geometry {

struct EyeLight {
  bool point;       // else directional
  float vector[3];  // eye space: the light's place, or the unit direction to it
  float color[3];
};

}  // namespace mars::geometry
