// What of a text a terminal gets.
#include "hal/failure/plain_text.h"

#include <gtest/gtest.h>

#include "hal/failure/failure.h"

namespace mars {
namespace {

TEST(PlainText, StaysAsItIs) {
  const std::string text = "a film\tof \"Käte\", 日本語 and 😀\n";
  EXPECT_EQ(plain_text(text), text);
  EXPECT_EQ(plain_text(""), "");
}

TEST(PlainText, ControlCharactersAreWrittenAsJsonWritesThem) {
  EXPECT_EQ(plain_text("a\x1b[2J\rb\x7f"
                       "c\xc2\x9b"
                       "d\xc2\x80"),
            R"(a\u001b[2J\u000db\u007fc\u009bd\u0080)");
  EXPECT_EQ(plain_text(std::string_view("\0", 1)), R"(\u0000)");
  EXPECT_EQ(plain_line("a\n\tb"), R"(a\u000a\u0009b)");
}

TEST(PlainText, APlaceIsOneLine) {
  EXPECT_STREQ(Failure("is missing", "a\nmars: all is well.json", "").what(),
               "a\\u000amars: all is well.json: is missing");
}

TEST(PlainText, DoesNotTurnAround) {
  EXPECT_EQ(plain_text("a\u202egnp.\u202c \u2066\u2069 \u2065\u206a"),
            "a\\u202egnp.\\u202c \\u2066\\u2069 \u2065\u206a");
}

TEST(PlainText, BytesThatAreNoCharacterAreShown) {
  EXPECT_EQ(plain_text("\x9b[2J"), R"(\x9b[2J)");
  EXPECT_EQ(plain_text("\xc3"), R"(\xc3)");          // cut off
  EXPECT_EQ(plain_text("\xc0\x9b"), R"(\xc0\x9b)");  // longer than it need be
  EXPECT_EQ(plain_text("\xe0\x82\x9b"), R"(\xe0\x82\x9b)");
  EXPECT_EQ(plain_text("\xed\xa0\x80"), R"(\xed\xa0\x80)");                    // half of a pair of UTF-16
  EXPECT_EQ(plain_text("\xf4\x90\x80\x80 \xff"), R"(\xf4\x90\x80\x80 \xff)");  // beyond the last one
}

TEST(PlainText, IsWhatFailuresHave) {
  const Failure failure("has \x1b[2J", "a\xc2\x9b.json", "take \u202e out");
  EXPECT_STREQ(failure.what(), R"(a\u009b.json: has \u001b[2J (take \u202e out))");
}

}  // namespace
}  // namespace mars
