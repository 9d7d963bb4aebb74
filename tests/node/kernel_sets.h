// The instruction sets to test.
#pragma once

#include <vector>

#include "node/kernels.h"

namespace mars::test {

// The kernels of all that this CPU runs, the narrowest first.
inline std::vector<const node::Kernels*> all_kernels() {
  std::vector<const node::Kernels*> all;
  for (const char* limit : {"sse2", "sse4", "avx2", "avx512"}) {
    const node::Kernels& kernels = node::best_kernels(limit);
    if (all.empty() || all.back() != &kernels) all.push_back(&kernels);
  }
  return all;
}

}  // namespace mars::test
