#include "host/shell/launch/text_reader.h"

#include <gtest/gtest.h>

namespace mars::launch {
namespace {

TEST(TextReader, ReadsFromLeftToRight) {
  TextReader reader("rank 2 on node ada, signal 9 (Killed)");
  EXPECT_FALSE(reader.find("machine"));
  EXPECT_TRUE(reader.find("rank "));
  EXPECT_EQ(reader.number(), 2u);
  EXPECT_FALSE(reader.number().has_value()) << "a blank comes first";
  EXPECT_FALSE(reader.skip("on node ")) << "a blank comes first";
  reader.skip_space();
  EXPECT_TRUE(reader.skip("on node "));
  EXPECT_EQ(reader.word(), "ada,");
  EXPECT_FALSE(reader.find("rank ")) << "that is behind us";
  EXPECT_TRUE(reader.find("(Killed)"));
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(reader.word(), "");
}

TEST(TextReader, TakesNoNumberThatDoesNotFit) {
  EXPECT_EQ(TextReader("4294967295").number(), 4294967295u);
  for (const char* text : {"4294967296", "99999999999999999999", "-1", "x", ""})
    EXPECT_FALSE(TextReader(text).number().has_value()) << text;
}

TEST(TextReader, AWordIsBounded) {
  const std::string longest(TextReader::kLongestWord, 'y');
  const std::string text = longest + " " + longest + "y";
  TextReader reader(text);
  EXPECT_EQ(reader.word(), longest);
  reader.skip_space();
  EXPECT_FALSE(reader.word().has_value());
  EXPECT_TRUE(reader.at_end()) << "all of it is read";
}

TEST(OnOneLine, HasNoBreaks) {
  EXPECT_EQ(on_one_line("  exited on\n\tsignal  9\n"), "exited on signal 9");
  EXPECT_EQ(on_one_line(""), "");
}

}  // namespace
}  // namespace mars::launch
