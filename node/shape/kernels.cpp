#include "node/shape/kernels.h"

#include <cstddef>

#include "node/simd/instruction_set.h"

namespace mars::shape {

namespace sse2 {
extern const ShapeKernels shape_kernels;
}
namespace sse4 {
extern const ShapeKernels shape_kernels;
}
namespace avx2 {
extern const ShapeKernels shape_kernels;
}
namespace avx512 {
extern const ShapeKernels shape_kernels;
}

const ShapeKernels& shape_kernels(simd::InstructionSet set) {
  static constexpr const ShapeKernels* kTables[] = {&sse2::shape_kernels, &sse4::shape_kernels, &avx2::shape_kernels,
                                                    &avx512::shape_kernels};
  return *kTables[static_cast<std::size_t>(set)];
}

}  // namespace mars::shape
