#include "node/raster/kernels.h"

#include <cstddef>

#include "node/simd/instruction_set.h"

namespace mars::raster {

namespace sse2 {
extern const RasterKernels raster_kernels;
}
namespace sse4 {
extern const RasterKernels raster_kernels;
}
namespace avx2 {
extern const RasterKernels raster_kernels;
}
namespace avx512 {
extern const RasterKernels raster_kernels;
}

const RasterKernels& raster_kernels(simd::InstructionSet set) {
  static constexpr const RasterKernels* kTables[] = {&sse2::raster_kernels, &sse4::raster_kernels,
                                                     &avx2::raster_kernels, &avx512::raster_kernels};
  return *kTables[static_cast<std::size_t>(set)];
}

}  // namespace mars::raster
