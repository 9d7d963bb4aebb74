#include "host/render/events/events.h"

#include <gtest/gtest.h>

namespace mars::events {
namespace {

std::vector<Event> one_of_each() {
  Progress progress;
  progress.intervals = 4;
  progress.keyframes = {1, 4, 0.5};
  progress.inbetweens = {7, 20, 0.125};
  progress.interval = 2;
  Progress foreseen = progress;
  foreseen.forecast = {1.5, 2.25};
  Progress bounded = progress;
  bounded.forecast = {1.5, 2.25, {{3, 4.5}}};
  return {
      Loading{"film.json"},
      Loaded{23.5},
      Warning{"film.json: actor 'anna', joint \"knee\""},
      Booted{"mpi", 2, {{0, "ada", 2, "core 0", "avx2"}, {1, "bob", 1, "", "sse2"}}},
      progress,
      foreseen,
      bounded,
      FrameTaken{12, 2, FrameKind::inbetween},
      FrameTaken{0, 0, FrameKind::keyframe},
      Fault{"a \"problem\"\nof two lines", "film.json:3", "mend it", {}, {}, ""},
      Fault{"out of memory", "node 3, frame 12", "", 3, 12, "mars render x.json --frames 12"},
      Fault{"frames that were rendered are gone: 3-4", "out", "", {}, {}, "", 2},
      Resumed{12, 72, "film.json has changed: frames 24-35 are rendered again"},
      Beat{"rendering", {{3, "n2", 17, "scanline", 11.5}}},
      Drawing{{{0, 4}, {3, 17}}},
      Done{24, 1.5, "build/demo", 7},
  };
}

TEST(Events, EachIsOneLineThatReadsAgain) {
  for (const Event& event : one_of_each()) {
    const std::string line = line_of(event);
    EXPECT_EQ(line.find('\n'), line.size() - 1) << line;
    EXPECT_EQ(read_event(line), event) << line;
  }
}

TEST(Events, AnyTextIsToldAsValidJson) {
  const std::optional<Event> event = read_event(line_of(Fault{"\xff\xfe name", "", "", {}, {}, ""}));
  ASSERT_TRUE(event.has_value());
  EXPECT_TRUE(std::get<Fault>(*event).problem.ends_with(" name"));
}

TEST(Events, WhatIsNotKnownIsPassedOver) {
  for (const char* line :
       {"", "hello", "{", "3", "[]", "null", "{}", "{\"event\":\"heartbeat\",\"node\":3}", "{\"event\":5}",
        "{\"event\":\"frame\"}", "{\"event\":\"done\",\"frames\":\"many\"}", "\xff\xff"})
    EXPECT_EQ(read_event(line), std::nullopt) << line;
  EXPECT_TRUE(read_event("{\"event\":\"done\",\"frames\":3,\"seconds\":1,\"folder\":\"\",\"later\":[1]}"));
}

TEST(Progress, CountsEverySecondOnce) {
  Progress progress;
  progress.keyframes.of = 2;
  progress.inbetweens.of = 10;
  EXPECT_FALSE(progress.left());
  progress.count(FrameKind::keyframe, 0, 4.0);
  progress.count(FrameKind::inbetween, 0, 4.5);
  progress.count(FrameKind::inbetween, 0, 5.0);
  EXPECT_EQ(progress.keyframes.seconds, 4.0);
  EXPECT_EQ(progress.inbetweens.seconds, 1.0);
  EXPECT_EQ(progress.done(), 3u);
  EXPECT_EQ(progress.of(), 12u);
}

// Frames are counted when their files are there, which need not be the order in which they came.
TEST(Progress, AFrameThatIsCountedLateTookNoTime) {
  Progress progress;
  progress.count(FrameKind::inbetween, 1, 5.0);
  progress.count(FrameKind::keyframe, 0, 3.0);
  progress.count(FrameKind::inbetween, 0, 5.5);
  EXPECT_EQ(progress.keyframes.seconds, 0);
  EXPECT_EQ(progress.inbetweens.seconds, 5.5);
}

// One keyframe of 4 seconds and eight inbetweens of half a second are left.
TEST(Progress, ExpectsEachKindToTakeAsLongAsBefore) {
  Progress progress;
  progress.keyframes = {1, 2, 4.0};
  progress.inbetweens = {2, 10, 1.0};
  EXPECT_DOUBLE_EQ(progress.left()->keyframes, 4.0);
  EXPECT_DOUBLE_EQ(progress.left()->inbetweens, 4.0);
}

TEST(Progress, AKindNotSeenYetIsExpectedToTakeAsTheOther) {
  Progress progress;
  progress.keyframes = {1, 2, 4.0};
  progress.inbetweens = {0, 10, 0};
  EXPECT_DOUBLE_EQ(progress.left()->inbetweens, 40.0);
}

TEST(Progress, AForecastCountsMoreThanWhatCame) {
  Progress progress;
  progress.keyframes = {1, 2, 4.0};
  progress.forecast = {1, 2};
  EXPECT_EQ(progress.left(), (Progress::Left{1, 2}));
}

}  // namespace
}  // namespace mars::events
