#include "host/shell/launch/display.h"

#include <gtest/gtest.h>

#include <chrono>
#include <sstream>
#include <thread>

namespace mars::launch {
namespace {

events::Progress some_progress() {
  events::Progress progress;
  progress.intervals = 5;
  progress.interval = 1;
  progress.keyframes = {1, 2, 3.0};
  progress.inbetweens = {9, 20, 4.5};
  return progress;
}

TEST(Display, Clock) {
  EXPECT_EQ(clock_text(0), "0:00");
  EXPECT_EQ(clock_text(7.4), "0:07");
  EXPECT_EQ(clock_text(61), "1:01");
  EXPECT_EQ(clock_text(3723), "1:02:03");
}

TEST(Display, ProgressKeepsTheKindsApart) {
  EXPECT_EQ(progress_text(some_progress()),
            "frame 10 of 22, interval 2 of 5, 1.3 frames/s, 0:09 left (keyframes 0:03, inbetweens 0:06)");
}

TEST(Display, ProgressOfOneKind) {
  events::Progress progress = some_progress();
  progress.inbetweens = {};
  EXPECT_EQ(progress_text(progress), "frame 1 of 2, interval 2 of 5, 0.3 frames/s, 0:03 left");
}

TEST(Display, ProgressBeforeTheFirstFrame) {
  events::Progress progress = some_progress();
  progress.keyframes.done = progress.inbetweens.done = 0;
  EXPECT_EQ(progress_text(progress), "frame 0 of 22");
  progress.forecast = {3, 60};
  EXPECT_EQ(progress_text(progress), "frame 0 of 22, 1:03 left (keyframes 0:03, inbetweens 1:00)");
}

TEST(Display, ProgressHasTheBoundsOfAForecast) {
  events::Progress progress = some_progress();
  progress.keyframes.done = progress.inbetweens.done = 0;
  progress.forecast = {3, 60, {{58, 75}}};
  EXPECT_EQ(progress_text(progress), "frame 0 of 22, 1:03 left, 90 %: 0:58 to 1:15 (keyframes 0:03, inbetweens 1:00)");
  progress.forecast = {3, 60, {{62.9, 63.1}}};
  EXPECT_EQ(progress_text(progress), "frame 0 of 22, 1:03 left (keyframes 0:03, inbetweens 1:00)");
}

TEST(Display, PlainLinesBeginWithThePercentage) {
  EXPECT_EQ(progress_line(some_progress()), "Progress: 45%, " + progress_text(some_progress()));
  EXPECT_TRUE(progress_line({}).starts_with("Progress: 0%, "));
}

TEST(Display, PlainLinesAreWholeAndNotTooMany) {
  std::ostringstream out;
  Display display(Display::Kind::lines, out);
  display.print("begin");
  for (int i = 0; i < 100; ++i) display.show(some_progress());
  display.settle();
  display.print("end");
  EXPECT_EQ(out.str(), "begin\n" + progress_line(some_progress()) + "\nend\n");
}

TEST(Display, ASecondJobHasLinesOfItsOwn) {
  std::ostringstream out;
  Display display(Display::Kind::lines, out);
  display.show(some_progress());
  display.settle();
  std::this_thread::sleep_for(std::chrono::milliseconds(2100));
  display.show(some_progress());
  EXPECT_EQ(out.str(), progress_line(some_progress()) + "\n" + progress_line(some_progress()) + "\n");
}

TEST(Display, ATerminalsLineIsWrittenOver) {
  std::ostringstream out;
  Display display(Display::Kind::terminal, out);
  display.show(some_progress());
  display.print("end");
  const std::string text = out.str();
  EXPECT_EQ(text.substr(0, 4), "\r\x1b[K");
  EXPECT_TRUE(text.ends_with("\r\x1b[Kend\n"));
}

TEST(Display, SilentIsSilent) {
  std::ostringstream out;
  Display display(Display::Kind::silent, out);
  display.print("begin");
  display.show(some_progress());
  display.settle();
  EXPECT_EQ(out.str(), "");
}

TEST(Display, WhatIsThereAlready) {
  EXPECT_EQ(resumed_text({12, 72, ""}), "12 of 72 frames are there already");
  EXPECT_EQ(resumed_text({72, 72, ""}), "72 of 72 frames are there already: nothing is left to render");
  EXPECT_EQ(resumed_text({0, 1, "a.json has changed"}), "a.json has changed");
}

TEST(Display, OtherLines) {
  EXPECT_EQ(booted_text({"mpi", 1, {{0, "ada", 1, "core 0", "avx2"}, {1, "ada", 2, "core 1", "avx2"}}}),
            "2 nodes on 1 machine (mpi), avx2");
  EXPECT_EQ(done_text({30, 2.0, "out"}), "30 frames in out, 2.0 seconds, 15.0 frames/s");
  EXPECT_EQ(done_text({1, 2.0, ""}), "1 frame, 2.0 seconds, 0.5 frames/s");
  EXPECT_EQ(done_text({96, 0.012, ""}), "96 frames, 0.012 seconds, 8000.0 frames/s");
  EXPECT_EQ(done_text({1, 2.0, "", 3}),
            "1 frame, 2.0 seconds, 0.5 frames/s\nthe trace was full: it lacks 3 later events");
}

}  // namespace
}  // namespace mars::launch
