#include "host/content/film/frame_set.h"

#include <gtest/gtest.h>

#include "tests/host/content/document/failure_of.h"

namespace mars::film {
namespace {

using Frames = std::vector<std::uint32_t>;

TEST(FrameSet, NamesFrames) {
  EXPECT_EQ(FrameSet().of_film(3), (Frames{0, 1, 2}));
  EXPECT_EQ(FrameSet("1").of_film(3), Frames{1});
  EXPECT_EQ(FrameSet("0-2,5,8-").of_film(11), (Frames{0, 1, 2, 5, 8, 9, 10}));
  EXPECT_EQ(FrameSet("0-").of_film(2), (Frames{0, 1}));
  EXPECT_EQ(FrameSet("4,1-2,2,4-4").of_film(5), (Frames{1, 2, 4})) << "ascending, each once";
}

TEST(FrameSet, StepsFromTheFirstOfAStretch) {
  EXPECT_EQ(FrameSet("1-9x3,2").of_film(10), (Frames{1, 2, 4, 7}));
  EXPECT_EQ(FrameSet("4-x2").of_film(10), (Frames{4, 6, 8}));
  EXPECT_EQ(FrameSet().every(4).of_film(10), (Frames{0, 4, 8}));
  EXPECT_EQ(FrameSet("0-6,9").every(3).text(), "0-6x3,9") << "one frame stays one";
  EXPECT_EQ(FrameSet("0-6,9").every(3).of_film(10), (Frames{0, 3, 6, 9}));
  EXPECT_EQ(FrameSet("0-x2").every(3), FrameSet("0-x6"));
  EXPECT_EQ(FrameSet("0-9x4294967295").of_film(10), Frames{0});
  EXPECT_EQ(FrameSet("3-x5").first_frames(3), (Frames{3, 8, 13}));
  EXPECT_EQ(FrameSet("0-9x4").first_frames(5), (Frames{0, 4, 8}));
}

TEST(FrameSet, TellsWhichPartIsWrong) {
  const auto failure = [](const char* text) { return document::failure_of([&] { FrameSet{text}; }); };
  for (const char* text : {"", ",", "1,", ",1", "-", "-3", "1--2", "1-2-3", "x", "1 ", " 1", "1.5", "+1", "0x1", "1-2x",
                           "1-2xx2", "1-2x-1"})
    EXPECT_TRUE(document::holds(failure(text), "is not a frame or a range of frames")) << "'" << text << "'";
  EXPECT_TRUE(document::holds(failure("0-3,b"), "'b'"));
  EXPECT_TRUE(document::holds(failure("5-4"), "'5-4' ends before it begins"));
  EXPECT_TRUE(document::holds(failure("4294967296"), "too large"));
  EXPECT_TRUE(document::holds(failure("1-2x0"), "'1-2x0' has a step of 0"));
  EXPECT_TRUE(document::holds(failure("x"), "like 0-9,24,30-"));
}

TEST(FrameSet, TellsWhereTheFilmIsTooShort) {
  const auto failure = [](const char* text) { return document::failure_of([&] { FrameSet(text).of_film(10); }); };
  EXPECT_EQ(failure("0-9"), "");
  EXPECT_TRUE(document::holds(failure("0-10"), "frame 10 is beyond the film's last, 9"));
  EXPECT_TRUE(document::holds(failure("10"), "frame 10 is beyond"));
  EXPECT_TRUE(document::holds(failure("12-"), "frame 12 is beyond"));
  EXPECT_TRUE(document::holds(failure("0-4294967295"), "frame 4294967295 is beyond"));
}

TEST(FrameSet, TextReadsAgain) {
  for (const char* text : {"0-", "3", "0-9,24,30-", "5,1", "0-9x3,4-x2"}) EXPECT_EQ(FrameSet(text).text(), text);
  EXPECT_EQ(FrameSet("4-4").text(), "4");
  EXPECT_EQ(FrameSet().text(), "0-");
}

TEST(FrameSet, TextOfFramesReadsAgain) {
  for (const auto& [frames, text] : {std::pair{Frames{}, ""},
                                     {Frames{7}, "7"},
                                     {Frames{0, 1, 2, 5, 8, 9}, "0-2,5,8-9"},
                                     {Frames{0, 2, 4}, "0,2,4"},
                                     {Frames{0, 2, 4, 6, 7}, "0,2,4,6-7"},
                                     {Frames{0, 1, 3, 5, 7, 9}, "0-1,3-9x2"}}) {
    EXPECT_EQ(FrameSet(frames).text(), text);
    EXPECT_TRUE(frames.empty() || FrameSet(text).of_film(10) == frames) << text;
  }
  EXPECT_EQ(FrameSet(Frames{4294967294, 4294967295}).text(), "4294967294-4294967295");
}

}  // namespace
}  // namespace mars::film
