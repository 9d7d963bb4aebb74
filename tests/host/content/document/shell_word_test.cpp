// Words for shells.
#include "host/content/document/shell_word.h"

#include <gtest/gtest.h>

namespace mars::document {
namespace {

TEST(ShellWord, IsInQuotationMarksWhereItHasTo) {
  EXPECT_EQ(shell_word("out/film.json"), "out/film.json");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("my film's.json"), R"('my film'\''s.json')");
  EXPECT_EQ(shell_word("Käte"), "'Käte'");
}

TEST(ShellWord, CanBeShownWhateverIsInIt) {
  EXPECT_EQ(shell_word("a\x1b[2J'\\\n"), R"($'a\033[2J\047\134\012')");
  EXPECT_EQ(shell_word("\u202e"), R"($'\342\200\256')");
}

}  // namespace
}  // namespace mars::document
