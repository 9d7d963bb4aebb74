// The instruction sets to test.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "node/simd/instruction_set.h"

namespace mars::test {

inline constexpr node::InstructionSet kSets[] = {node::InstructionSet::sse2, node::InstructionSet::sse4,
                                                 node::InstructionSet::avx2, node::InstructionSet::avx512};

// Whether this CPU runs it.
inline bool is_here(node::InstructionSet set) { return node::best_instruction_set(node::name_of(set)) == set; }

// All that this CPU runs, the narrowest first.
inline std::vector<node::InstructionSet> sets_here() {
  std::vector<node::InstructionSet> here;
  for (const node::InstructionSet set : kSets)
    if (is_here(set)) here.push_back(set);
  return here;
}

// Shows the running test as skipped, unless it fails, where this CPU lacks a set: on the others it goes on. Not before
// its body, which would not begin.
inline void skip_sets_not_here() {
  if (testing::Test::IsSkipped()) return;
  for (const node::InstructionSet set : kSets)
    if (!is_here(set)) GTEST_SKIP() << "not on " << node::name_of(set) << ", which this CPU lacks";
}

// For a test's body: sets_here(), of which it says when they are not all.
inline std::vector<node::InstructionSet> all_sets() {
  skip_sets_not_here();
  return sets_here();
}

}  // namespace mars::test
