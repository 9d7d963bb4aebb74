// What pages say, read from anything.
#include "host/studio/web/page_message.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "hal/failure/failure.h"

namespace mars::web {
namespace {

TEST(PageMessage, IsAnObjectThatAsksForSomething) {
  EXPECT_EQ(read_page_message(R"({"do": "undo"})")["do"], "undo");
  for (const char* text :
       {"", "{", "null", "3", "[]", "\"undo\"", "{}", R"({"do": 3})", R"({"do": null})", "{'do': 1}",
        R"({"do": "undo"} x)", R"({"do": "undo", "x": NaN})", R"({"do": "undo", "x": 1e999})", "{\"do\": \"\xff\"}"})
    EXPECT_THROW(read_page_message(text), Failure) << text;
}

TEST(PageMessage, IsNeitherLongNorDeep) {
  const std::string long_text(kMostMessage, 'x');
  EXPECT_THROW(read_page_message(R"({"do": ")" + long_text + "\"}"), Failure);
  const auto nested = [](int depth) {
    return R"({"do": "x", "y": )" + std::string(depth, '[') + std::string(depth, ']') + "}";
  };
  EXPECT_NO_THROW(read_page_message(nested(10)));
  EXPECT_THROW(read_page_message(nested(20)), Failure);
  EXPECT_THROW(read_page_message(nested(30000)), Failure);
}

TEST(PageMessage, TenThousandDamagedOnesAreReadOrRefused) {
  const std::string good = R"({"do": "drag", "edit": 12, "x": 1.5, "y": -3e2, "keys": ["shift"], "step": {"a": [1]}})";
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 10000; ++i) {
    std::string text = good;
    for (int change = 0; change < 3; ++change) text[random() % text.size()] = static_cast<char>(random());
    if (i % 5 == 0) text.resize(random() % text.size());
    try {
      read_page_message(text);
    } catch (const Failure&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 5000);
}

}  // namespace
}  // namespace mars::web
