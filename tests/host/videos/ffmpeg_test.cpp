#include "host/videos/ffmpeg.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/host/content/document/failure_of.h"

namespace mars::videos {
namespace {

using namespace std::chrono_literals;

const std::vector<std::byte> kMuch(1 << 22);  // more than a socket holds

// Whoever stops it, nobody waits for it for ever, and a person learns of it.
TEST(Ffmpeg, OneThatIsStoppedIsGivenUp) {
  std::vector<std::string> lines;
  const Bounds bounds{[&](const std::string& line) { lines.push_back(line); }, 200ms, 500ms};
  Ffmpeg stopped("/bin/sh", {"-c", "kill -STOP $$"}, "film.mp4", bounds);
  const std::string failure = document::failure_of([&] { stopped.feed(kMuch); });
  EXPECT_TRUE(document::holds(failure, "film.mp4: ffmpeg has done nothing for 1 second")) << failure;
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(document::holds(lines[0], "is it stopped"));
}

TEST(Ffmpeg, OneThatDoesNotEndIsGivenUp) {
  Ffmpeg sleeps("/bin/sh", {"-c", "exec sleep 100"}, "film.mp4", {{}, 200ms, 400ms});
  EXPECT_TRUE(document::holds(document::failure_of([&] { sleeps.finish(); }), "done nothing"));
}

// Ten milliseconds of work now and then, twice as long as one may be idle: a busy machine gives it that much.
TEST(Ffmpeg, OneThatWorksLongIsNot) {
  constexpr const char* kWork =
      "trap 'exit 0' TERM; (sleep 4; kill $$) & "
      "while :; do i=0; while [ $i -lt 40000 ]; do i=$((i + 1)); done; sleep 0.1; done";
  Ffmpeg works("/bin/sh", {"-c", kWork}, "film.mp4", {{}, 100ms, 2000ms});
  EXPECT_EQ(document::failure_of([&] { works.finish(); }), "");
}

TEST(Ffmpeg, SaysWhyItFailed) {
  const auto failure = [](const char* script) {
    return document::failure_of([&] {
      Ffmpeg ffmpeg("/bin/sh", {"-c", script}, "film.mp4", {});
      ffmpeg.feed(kMuch);
      ffmpeg.finish();
    });
  };
  EXPECT_TRUE(document::holds(failure("echo no encoder >&2; exit 1"), "no encoder"));
  EXPECT_TRUE(document::holds(failure("kill -9 $$"), "killed by signal 9"));
  EXPECT_TRUE(document::holds(failure("exit 0"), "ended without a video"));
  EXPECT_TRUE(document::holds(failure("echo f: No space left on device >&2; exit 1"), "free some space"));
  EXPECT_EQ(failure("cat > /dev/null"), "");
}

TEST(Ffmpeg, IsGivenMoreThanItsInput) {
  Ffmpeg reads("/bin/sh", {"-c", "cat <&3; cat"}, "film.mp4", {}, "more, ");
  reads.feed(std::as_bytes(std::span("input", 5)));
  reads.finish();
  EXPECT_EQ(reads.printed(), "more, input");
}

}  // namespace
}  // namespace mars::videos
