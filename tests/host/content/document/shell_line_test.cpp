#include "host/content/document/shell_line.h"

#include <gtest/gtest.h>

#include "host/content/document/shell_word.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::document {
namespace {

using Words = std::vector<std::string>;

TEST(ShellWords, AreApartAtBlanks) {
  EXPECT_EQ(shell_words("--account=x  --qos\thigh\n"), (Words{"--account=x", "--qos", "high"}));
  EXPECT_EQ(shell_words(" "), Words());
}

TEST(ShellWords, HoldBlanksInQuotationMarks) {
  EXPECT_EQ(shell_words(R"(--comment="two words" '--name=it is' a' 'b)"),
            (Words{"--comment=two words", "--name=it is", "a b"}));
  EXPECT_EQ(shell_words(R"('' "")"), (Words{"", ""}));
}

TEST(ShellWords, HoldWhatFollowsABackslash) {
  EXPECT_EQ(shell_words(R"(a\ b \' "\"\n" '\')"), (Words{"a b", "'", R"("\n)", R"(\)"}));
}

TEST(ShellWords, ExpandNothing) { EXPECT_EQ(shell_words("$HOME *.json a&b|c"), (Words{"$HOME", "*.json", "a&b|c"})); }

TEST(ShellWords, AreThoseThatWereQuoted) {
  const Words words{"plain", "", "it's", "a \"b\" \\", "$(rm x)"};
  std::string line;
  for (const std::string& word : words) line += shell_word(word) + " ";
  EXPECT_EQ(shell_words(line), words);
}

TEST(ShellWords, AreNotLeftOpen) {
  EXPECT_TRUE(holds(failure_of([] { shell_words("--comment='two words"); }), "the quotation mark ' is not closed"));
  EXPECT_TRUE(holds(failure_of([] { shell_words("a\\"); }), "a backslash is the last letter"));
}

}  // namespace
}  // namespace mars::document
