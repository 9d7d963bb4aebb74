#include "node/shading/kernels.h"

#include <cstddef>

#include "node/simd/instruction_set.h"

namespace mars::shading {

namespace sse2 {
extern const ShadingKernels shading_kernels;
}
namespace sse4 {
extern const ShadingKernels shading_kernels;
}
namespace avx2 {
extern const ShadingKernels shading_kernels;
}
namespace avx512 {
extern const ShadingKernels shading_kernels;
}

const ShadingKernels& shading_kernels(simd::InstructionSet set) {
  static constexpr const ShadingKernels* kTables[] = {&sse2::shading_kernels, &sse4::shading_kernels,
                                                      &avx2::shading_kernels, &avx512::shading_kernels};
  return *kTables[static_cast<std::size_t>(set)];
}

}  // namespace mars::shading
