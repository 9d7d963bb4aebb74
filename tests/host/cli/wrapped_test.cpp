#include "host/cli/wrapped.h"

#include <gtest/gtest.h>

namespace mars::cli {
namespace {

TEST(Wrapped, BreaksAtSpacesAndIndentsWhatFollows) {
  EXPECT_EQ(wrapped("one two three", 2, 9), "one two\n  three");
  EXPECT_EQ(wrapped("one two three", 2, 10), "one two\n  three");
  EXPECT_EQ(wrapped("one two three", 0, 13), "one two three");
}

TEST(Wrapped, KeepsLongWordsAndLineEnds) {
  EXPECT_EQ(wrapped("a abcdefghijk b", 1, 6), "a\n abcdefghijk\n b");
  EXPECT_EQ(wrapped("one\ntwo", 3, 40), "one\n   two");
  EXPECT_EQ(wrapped("", 3, 40), "");
}

}  // namespace
}  // namespace mars::cli
