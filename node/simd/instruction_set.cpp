// Which of the compiled kernels this CPU runs.
#include <algorithm>
#include <array>
#include <string>

#include "hal/failure/failure.h"
#include "node/simd/kernels.h"

namespace mars::node {

extern const Kernels kernels_sse2;
extern const Kernels kernels_sse4;
extern const Kernels kernels_avx2;
extern const Kernels kernels_avx512;

namespace {

struct Choice {
  const Kernels* kernels;
  bool runs_here;
};

// The narrowest first.
std::array<Choice, 4> choices() {
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
                    __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
  return {Choice{&kernels_sse2, true}, {&kernels_sse4, __builtin_cpu_supports("sse4.2") != 0}, {&kernels_avx2, avx2},
          {&kernels_avx512, avx512}};
}

}  // namespace

const Kernels& best_kernels(std::string_view limit) {
  const auto all = choices();
  const auto last = limit.empty() ? all.end() - 1 : std::find_if(all.begin(), all.end(), [&](const Choice& choice) {
    return choice.kernels->name == limit;
  });
  if (last == all.end())
    throw Failure("there are no kernels for '" + std::string(limit) + "'", "MARS_SIMD",
                  "use sse2, sse4, avx2 or avx512");
  const Kernels* best = all.front().kernels;
  for (auto choice = all.begin(); choice <= last; ++choice)
    if (choice->runs_here) best = choice->kernels;
  return *best;
}

}  // namespace mars::node
