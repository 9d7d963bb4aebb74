// The instruction sets to test.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "node/simd/instruction_set.h"

namespace mars::simd {

inline constexpr InstructionSet kSets[] = {InstructionSet::sse2, InstructionSet::sse4, InstructionSet::avx2,
                                           InstructionSet::avx512};

// Whether this CPU runs it.
inline bool is_here(InstructionSet set) { return best_instruction_set(name_of(set)) == set; }

// All that this CPU runs, the narrowest first.
inline std::vector<InstructionSet> sets_here() {
  std::vector<InstructionSet> here;
  for (const InstructionSet set : kSets)
    if (is_here(set)) here.push_back(set);
  return here;
}

// Shows the running test as skipped, unless it fails, where this CPU lacks a set: on the others it goes on. Not before
// its body, which would not begin.
inline void skip_sets_not_here() {
  if (testing::Test::IsSkipped()) return;
  for (const InstructionSet set : kSets)
    if (!is_here(set)) GTEST_SKIP() << "not on " << name_of(set) << ", which this CPU lacks";
}

// For a test's body: sets_here(), of which it says when they are not all.
inline std::vector<InstructionSet> all_sets() {
  skip_sets_not_here();
  return sets_here();
}

}  // namespace mars::simd
