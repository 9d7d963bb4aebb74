#include "host/videos/video_form.h"

#include <gtest/gtest.h>

#include "tests/host/content/document/failure_of.h"

namespace mars::videos {
namespace {

TEST(VideoForm, EndingsSayWhichKind) {
  for (const char* name : {"a.mp4", "b/c.MOV", "a.mkv", "a.webm", "a.gif", "a.apng", "a.m4v"})
    EXPECT_TRUE(is_video_name(name)) << name;
  for (const char* name : {"a", "mp4", "a.png", "a.avi", "a.mp4/", ".mp4", "a.mp4.mars-work"})
    EXPECT_FALSE(is_video_name(name)) << name;
}

TEST(VideoForm, EachKindHasItsCodecs) {
  EXPECT_EQ(form_of("a.mp4", {}).codec->name, "h264");
  EXPECT_EQ(form_of("a.mp4", {}).quality, 16u);
  EXPECT_EQ(form_of("a.webm", {}).codec->name, "vp9");
  EXPECT_EQ(form_of("a.webm", {"av1", 40}).quality, 40u);
  EXPECT_FALSE(form_of("a.apng", {}).quality);
  for (const Kind& kind : kinds())
    for (const std::string_view codec : kind.codecs)
      EXPECT_EQ(form_of("a" + std::string(kind.ending), {std::string(codec), {}}).codec->name, codec);
  EXPECT_NE(document::failure_of([] { form_of("a.webm", {"h264", {}}); }), "");
  EXPECT_NE(document::failure_of([] { form_of("a.mp4", {"", 52}); }), "");
  EXPECT_NE(document::failure_of([] { form_of("a.gif", {"", 20}); }), "");
}

TEST(VideoForm, RatesOfTelevisionAreExact) {
  EXPECT_EQ(rate_text(24), "24");
  EXPECT_EQ(rate_text(12.5), "12.5");
  EXPECT_EQ(rate_text(23.976), "24000/1001");
  EXPECT_EQ(rate_text(29.97), "30000/1001");
  EXPECT_EQ(rate_text(59.94), "60000/1001");
  EXPECT_EQ(rate_text(0.001), "0.001");
  EXPECT_DOUBLE_EQ(exact_rate(29.97), 30000.0 / 1001);
  EXPECT_EQ(exact_rate(25), 25);
}

}  // namespace
}  // namespace mars::videos
