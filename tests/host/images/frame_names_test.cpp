#include "host/images/frame_names.h"

#include <gtest/gtest.h>

#include "tests/host/content/document/failure_of.h"

namespace mars::images {
namespace {

TEST(FrameNames, AreWrittenAsBlenderOrPrintfWritesThem) {
  EXPECT_EQ(frame_pattern("shot_####"), "shot_####");
  EXPECT_EQ(frame_pattern("shot_%04d"), "shot_####");
  EXPECT_EQ(frame_pattern("%d.v2"), "#.v2");
  EXPECT_EQ(frame_pattern("%012d"), "############");
  EXPECT_EQ(frame_pattern("shot_"), "shot_####") << "a name without a number gets one";
  for (const char* text : {"a##b##", "%d%d", "a#%03d"})
    EXPECT_TRUE(document::holds(document::failure_of([&] { frame_pattern(text); }), "more than one number")) << text;
  for (const char* text : {"%4d", "%s", "%", "a/####", ".####", "a\n#", "#####################"})
    EXPECT_NE(document::failure_of([&] { frame_pattern(text); }), "") << text;
  EXPECT_NE(document::failure_of([] { frame_pattern(std::string(101, 'x')); }), "");
}

TEST(FrameNames, HaveAtLeastTheirDigits) {
  EXPECT_EQ(frame_name({}, 7, 24), "frame-0007");
  EXPECT_EQ(frame_name({}, 7, 100'001), "frame-000007") << "names sort as frames do";
  EXPECT_EQ(frame_name({"", 99'990}, 7, 24), "frame-099997") << "the last is 100013";
  EXPECT_EQ(frame_name({"s##_x", 0}, 7, 1000), "s07_x");
  EXPECT_EQ(frame_name({"s##_x", 0}, 777, 1000), "s777_x");
  EXPECT_EQ(frame_name({"####", 1001}, 7, 24), "1008");
}

TEST(FrameNames, NameTheirFrames) {
  for (const FrameNames& names :
       {FrameNames{}, {"", 1001}, {"shot_##", 7}, {"#-end", 0}, {"########", kMostFirstNumber}})
    for (const std::uint32_t frame : {0u, 5u, 99u, 1999u})
      EXPECT_EQ(frame_of_name(names, frame_name(names, frame, 2000), 2000), frame) << names.pattern;
  const FrameNames names{"shot_####.a", 100};
  for (const char* name : {"shot_0099.a", "shot_0110.a", "shot_102.a", "shot_00102.a", "shot_0102", "shot_.a",
                           "shot_+102.a", "shot_0102.b", "Shot_0102.a", "", "shot_99999999999.a"})
    EXPECT_EQ(frame_of_name(names, name, 10), std::nullopt) << name;
  EXPECT_EQ(frame_of_name(names, "shot_0102.a", 10), 2u);
}

}  // namespace
}  // namespace mars::images
