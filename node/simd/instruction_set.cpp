#include "node/simd/instruction_set.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>

#include "hal/failure/failure.h"

namespace mars::simd {
namespace {

constexpr const char* kNames[] = {"sse2", "sse4", "avx2", "avx512"};

bool runs_here(InstructionSet set) {
  switch (set) {
    case InstructionSet::sse2: return true;
    case InstructionSet::sse4: return __builtin_cpu_supports("sse4.2") != 0;
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
             __builtin_cpu_supports("fma");
    case InstructionSet::avx512:
      return runs_here(InstructionSet::avx2) && __builtin_cpu_supports("avx512f") &&
             __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  }
  return false;
}

}  // namespace

const char* name_of(InstructionSet set) { return kNames[static_cast<std::size_t>(set)]; }

InstructionSet best_instruction_set(std::string_view limit) {
  const auto* named = std::find(std::begin(kNames), std::end(kNames), limit.empty() ? "avx512" : limit);
  if (named == std::end(kNames))
    throw Failure("there are no kernels for '" + std::string(limit) + "'", "MARS_SIMD",
                  "use sse2, sse4, avx2 or avx512");
  auto best = InstructionSet::sse2;
  for (const auto set : {InstructionSet::sse4, InstructionSet::avx2, InstructionSet::avx512})
    if (static_cast<int>(set) <= named - std::begin(kNames) && runs_here(set)) best = set;
  return best;
}

}  // namespace mars::simd
