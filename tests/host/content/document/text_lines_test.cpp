// Text that fits on a terminal's lines.
#include "host/content/document/text_lines.h"

#include <gtest/gtest.h>

namespace mars::document {
namespace {

using Lines = std::vector<std::string>;

TEST(TextLines, AreBrokenAtSpaces) {
  EXPECT_EQ(wrapped("", 10, 3), Lines{});
  EXPECT_EQ(wrapped("ten wide ..", 11, 3), Lines{"ten wide .."});
  EXPECT_EQ(wrapped("one two three", 7, 3), (Lines{"one two", "three"}));
  EXPECT_EQ(wrapped("one two three", 6, 3), (Lines{"one", "two", "three"}));
  EXPECT_EQ(wrapped("a/long/path is long", 6, 9), (Lines{"a/long", "/path", "is", "long"}));
}

TEST(TextLines, WhatDoesNotFitIsLeftOut) {
  EXPECT_EQ(wrapped("one two three", 7, 1), Lines{"one ..."});
  EXPECT_EQ(wrapped("one two three", 5, 2), (Lines{"one", "tw..."}));
  EXPECT_EQ(wrapped("one two", 2, 1), Lines{".."});
  EXPECT_EQ(cut_to("one two", 5), "one t");
  EXPECT_EQ(cut_to("one", 5), "one");
}

TEST(TextLines, CountCharacters) {
  EXPECT_EQ(cut_to("äöü", 2), "äö");
  EXPECT_EQ(wrapped("ä€ 😀b", 2, 2), (Lines{"ä€", "😀b"}));
}

TEST(TextLines, NothingMovesTheCursor) {
  EXPECT_EQ(cut_to("a\x1b[2J\nb\x7f\xc2\x9b"
                   "c\x80",
                   99),
            R"(a\u001b[2J\u000ab\u007f\u009bc\x80)");
  EXPECT_EQ(wrapped("\x1b\x1b", 6, 2), (Lines{R"(\u001b)", R"(\u001b)"}));
}

}  // namespace
}  // namespace mars::document
