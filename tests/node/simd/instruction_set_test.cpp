// Which of the compiled kernels run.
#include "node/simd/instruction_set.h"

#include <gtest/gtest.h>

#include "hal/failure/failure.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::simd {
namespace {

TEST(InstructionSet, IsChosenByName) {
  EXPECT_EQ(best_instruction_set("sse2"), InstructionSet::sse2);
  EXPECT_EQ(best_instruction_set(""), best_instruction_set("avx512"));
  EXPECT_EQ(best_instruction_set(""), sets_here().back());
  EXPECT_THROW(best_instruction_set("mmx"), Failure);
}

TEST(InstructionSet, NeverWiderThanAsked) {
  for (const InstructionSet set : kSets) EXPECT_LE(best_instruction_set(name_of(set)), set);
}

}  // namespace
}  // namespace mars::simd
