// What the kernels are measured against: loops that do the least that can be asked, plainly written and left to the
// compiler, which makes one version for each instruction set with the options of the kernels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "node/shading/shading.h"
#include "node/simd/instruction_set.h"

namespace mars::bench {

// Samples [first, last) of line `line` that show one triangle.
struct Piece {
  std::uint32_t triangle;
  std::uint32_t line;
  std::uint32_t first;
  std::uint32_t last;
};

// Phong's model along a stretch: normals and directions to the eye that grow by a step a sample.
struct Stretch {
  float normal[3], normal_step[3];
  float eye[3], eye_step[3];
};

struct Bare {
  using Shade = void (*)(const Stretch& stretch, const wire::Material& material, const geometry::EyeLight& light,
                         int count, std::uint32_t* pixels);
  // Interpolates, normalises both, N.L, R.V to the 32nd by five squarings, and packs `count` pixels.
  Shade shade;
  // The same with other models: Blinn's, Cook's and Torrance's, metallic-roughness; and colours that are only
  // interpolated.
  const Shade* models;
  // The planes' depths at the samples of all pieces, each written once to the one line `depth`.
  void (*write_depths)(const geometry::Triangle* triangles, const Piece* pieces, std::size_t count, float* depth);
  // The same samples' depths, computed before and lying one behind the other at `from`.
  void (*copy_depths)(const float* from, const Piece* pieces, std::size_t count, float* depth);
};

const Bare& bare_for(simd::InstructionSet set);

}  // namespace mars::bench
