// Which of the compiled kernels run.
#include "node/simd/instruction_set.h"

#include <gtest/gtest.h>

#include <string_view>

#include "hal/failure/failure.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::test {
namespace {

TEST(InstructionSet, IsChosenByName) {
  EXPECT_EQ(node::best_instruction_set("sse2"), node::InstructionSet::sse2);
  EXPECT_EQ(node::best_instruction_set(""), node::best_instruction_set("avx512"));
  EXPECT_EQ(node::best_instruction_set(""), sets_here().back());
  EXPECT_THROW(node::best_instruction_set("mmx"), Failure);
}

TEST(InstructionSet, NeverWiderThanAsked) {
  for (const node::InstructionSet set : kSets) EXPECT_LE(node::best_instruction_set(node::name_of(set)), set);
}

}  // namespace
}  // namespace mars::test
