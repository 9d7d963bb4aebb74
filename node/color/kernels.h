// From light to pixels by vectors, compiled for several instruction sets (kernels/); the bits are the same for all of
// them, and pixel_of's (encoding.h). Plain structs and pointers only, as in shape/kernels.h.
#pragma once

#include <cstdint>

#include "node/color/encoding.h"

namespace mars::simd {
enum class InstructionSet;
}

namespace mars::color {

struct ColorKernels {
  // The pixels of red, green and blue light[0..2][0, count), not negative, one behind the other to `pixels`, in the
  // encoding's format. Light and pixels have kVectorSlack to spare.
  void (*encode)(const Encoding& encoding, const float* const* light, std::uint32_t count, void* pixels);
};

const ColorKernels& color_kernels(simd::InstructionSet set);

}  // namespace mars::color
