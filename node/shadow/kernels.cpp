#include "node/shadow/kernels.h"

#include <cstddef>

#include "node/simd/instruction_set.h"

namespace mars::shadow {

namespace sse2 {
extern const ShadowKernels shadow_kernels;
}
namespace sse4 {
extern const ShadowKernels shadow_kernels;
}
namespace avx2 {
extern const ShadowKernels shadow_kernels;
}
namespace avx512 {
extern const ShadowKernels shadow_kernels;
}

const ShadowKernels& shadow_kernels(simd::InstructionSet set) {
  static constexpr const ShadowKernels* kTables[] = {&sse2::shadow_kernels, &sse4::shadow_kernels,
                                                     &avx2::shadow_kernels, &avx512::shadow_kernels};
  return *kTables[static_cast<std::size_t>(set)];
}

}  // namespace mars::shadow
