// The instruction sets that kernels are compiled for, each kernel written once; the bits are the same for all of them.
// A folder with kernels has a table of them for each set (shape/kernels.h, shading/kernels.h, raster/kernels.h).
#pragma once

#include <string_view>

namespace mars::simd {

// The narrowest first.
enum class InstructionSet { sse2, sse4, avx2, avx512 };

// As MARS_SIMD and reports call it.
const char* name_of(InstructionSet set);

// The widest that this CPU runs and that is not wider than `limit` ("sse2", "sse4", "avx2", "avx512"; "" for no
// limit). Throws Failure for another name.
InstructionSet best_instruction_set(std::string_view limit);

}  // namespace mars::simd
