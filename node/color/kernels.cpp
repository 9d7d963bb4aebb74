#include "node/color/kernels.h"

#include <cstddef>

#include "node/simd/instruction_set.h"

namespace mars::color {

namespace sse2 {
extern const ColorKernels color_kernels;
}
namespace sse4 {
extern const ColorKernels color_kernels;
}
namespace avx2 {
extern const ColorKernels color_kernels;
}
namespace avx512 {
extern const ColorKernels color_kernels;
}

const ColorKernels& color_kernels(simd::InstructionSet set) {
  static constexpr const ColorKernels* kTables[] = {&sse2::color_kernels, &sse4::color_kernels, &avx2::color_kernels,
                                                    &avx512::color_kernels};
  return *kTables[static_cast<std::size_t>(set)];
}

}  // namespace mars::color
