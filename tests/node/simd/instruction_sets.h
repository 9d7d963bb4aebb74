// The instruction sets to test.
#pragma once

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "node/simd/kernels.h"

namespace mars::test {

inline constexpr const char* kSets[] = {"sse2", "sse4", "avx2", "avx512"};

// The kernels of all that this CPU runs, the narrowest first.
inline std::vector<const node::Kernels*> kernels_here() {
  std::vector<const node::Kernels*> here;
  for (const char* set : kSets) {
    const node::Kernels& kernels = node::best_kernels(set);
    if (kernels.name == std::string_view(set)) here.push_back(&kernels);
  }
  return here;
}

// Shows the running test as skipped, unless it fails, where this CPU lacks a set: on the others it goes on. Not before
// its body, which would not begin.
inline void skip_sets_not_here() {
  if (testing::Test::IsSkipped()) return;
  for (const char* set : kSets)
    if (node::best_kernels(set).name != std::string_view(set))
      GTEST_SKIP() << "not on " << set << ", which this CPU lacks";
}

// For a test's body: kernels_here(), of which it says when they are not all.
inline std::vector<const node::Kernels*> all_kernels() {
  skip_sets_not_here();
  return kernels_here();
}

}  // namespace mars::test
