// What a rough mirror sends to the eye of light that comes evenly from all around: a share of its colour straight on,
// plus a share of white (B. Karis, "Real shading in Unreal Engine 4", 2013: the split sum's second factor). A plain
// struct: kernels of several instruction sets share it.
#pragma once

namespace mars::shading {

struct EnvironmentTable {
  // By N.V, evenly from 0 to 1 within a row, and by roughness, evenly from 0 to 1 from row to row.
  static constexpr int kSide = 16;
  float colored[kSide * kSide];
  float white[kSide * kSide];
};

// GGX, Smith and Schlick, as in kernels/metallic_roughness.h. Computed when it is first asked for, with + - * / and
// roots alone.
const EnvironmentTable& environment_table();

}  // namespace mars::shading
