// Which of the compiled kernels this CPU runs.
#include <string>

#include "hal/failure.h"
#include "node/kernels.h"

namespace mars::node {

extern const Kernels kernels_sse2;
extern const Kernels kernels_avx2;
extern const Kernels kernels_avx512;

const Kernels& best_kernels(std::string_view limit) {
  if (!limit.empty() && limit != "sse2" && limit != "avx2" && limit != "avx512")
    throw Failure("there are no kernels for '" + std::string(limit) + "'", "MARS_SIMD", "use sse2, avx2 or avx512");
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  if (avx512 && (limit.empty() || limit == "avx512")) return kernels_avx512;
  if (__builtin_cpu_supports("avx2") && limit != "sse2") return kernels_avx2;
  return kernels_sse2;
}

}  // namespace mars::node
