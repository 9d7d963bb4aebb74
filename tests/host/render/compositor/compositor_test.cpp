// The compositor against a plain twin that draws every frame from scratch.
#include "host/render/compositor/compositor.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <random>

#include "host/render/compositor/plain_pixels.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::compositor {
namespace {

using Pixels = std::vector<std::uint32_t>;

struct Runs {
  std::vector<wire::Run> runs;
  Pixels pixels;
};

struct Size {
  std::uint32_t width, height, block;
  wire::PixelFormat format;
};

std::uint32_t words_of(const Size& size) { return static_cast<std::uint32_t>(wire::pixel_words(size.format)); }

void add_pixels(std::mt19937& random, const Size& size, std::uint32_t count, Pixels& pixels) {
  for (std::uint32_t i = 0; i < count * words_of(size); ++i) pixels.push_back(random() & 0xffffff);
}

// Lines of two runs each, one after the other, as nodes send them: they fill blocks.
Runs filling_runs(std::mt19937& random, const Size& size, std::uint32_t top, std::uint32_t lines) {
  Runs out;
  const std::uint32_t left = random() % 2 == 0 ? 0 : random() % size.width;
  const std::uint32_t right = random() % 2 == 0 ? size.width : left + 1 + random() % (size.width - left);
  for (std::uint32_t line = top + random() % lines; line < top + lines; ++line) {
    const std::uint32_t middle = left + random() % (right - left);
    for (const auto& [first, last] : {std::pair{left, middle}, {middle, right}})
      if (first < last)
        out.runs.push_back({line, static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(last - first)});
  }
  for (const wire::Run& run : out.runs) add_pixels(random, size, run.count, out.pixels);
  return out;
}

// Within part `part` of `parts` of the lines, for strips share no pixel.
Runs random_runs(std::mt19937& random, const Size& size, std::uint32_t part, std::uint32_t parts) {
  Runs out;
  const std::uint32_t top = size.height * part / parts;
  const std::uint32_t lines = size.height * (part + 1) / parts - top;
  if (lines > 0 && random() % 2 == 0) return filling_runs(random, size, top, lines);
  for (std::uint32_t run = lines == 0 ? 0 : random() % 12; run > 0; --run) {
    const std::uint32_t first = random() % size.width;
    const std::uint32_t most = size.width - first;
    const std::uint32_t count = 1 + random() % (random() % 2 == 0 ? most : std::min(most, 20u));
    out.runs.push_back({static_cast<std::uint32_t>(top + random() % lines), static_cast<std::uint16_t>(first),
                        static_cast<std::uint16_t>(count)});
    add_pixels(random, size, count, out.pixels);
  }
  return out;
}

void paste(const Runs& runs, const Size& size, Pixels& picture) {
  const std::uint32_t* source = runs.pixels.data();
  const std::uint32_t words = words_of(size);
  for (const wire::Run& run : runs.runs)
    for (std::uint32_t x = 0; x < run.count * words; ++x)
      picture[(run.line * size.width + run.first) * words + x] = *source++;
}

// Blocks in which two pictures differ must be flagged.
void expect_flagged(const Frame& frame, const Pixels& now, const Pixels& before) {
  const std::uint32_t block = frame.changed.block();
  for (std::size_t i = 0; i < now.size(); ++i) {
    const std::size_t pixel = i / wire::pixel_words(frame.format);
    const auto x = static_cast<std::uint32_t>(pixel % frame.width);
    const auto y = static_cast<std::uint32_t>(pixel / frame.width);
    const bool marked = frame.changed.at(x / block, y / block);
    ASSERT_TRUE(marked || now[i] == before[i]) << "changed at " << x << ", " << y;
  }
}

constexpr std::uint64_t kPlain = 0x0011223300302010, kOther = 0x0011223300102030;

// A compositor and its twin, a strip a step: tasks of one frame, and tasks of several with two inbetweens in the
// making at a time. Most intervals have the plain background kPlain.
class Twins {
 public:
  Twins(const Size& size, std::vector<Frame*>& buffers)
      : size_(size), buffers_(buffers), compositor_(size.width, size.height, size.block, size.format) {}

  void step(std::mt19937& random) {
    if (open_.empty() && left_ == 0) begin_unit(random);
    const auto all = static_cast<std::uint32_t>(open_.size());
    if (keyframe_parts_ == 0 && all < 2 && left_ > 0 && !buffers_.empty()) return begin_frame(random);
    if (keyframe_parts_ > 0) return keyframe_strip(random);
    if (all > 0) inbetween_strip(random, open_.begin() + random() % all);
  }

 private:
  struct Open {
    std::uint32_t number;
    Frame* frame;
    Pixels twin;
    std::uint32_t parts_left;
  };

  void begin_unit(std::mt19937& random) {
    const std::uint64_t plain = random() % 4 == 0 ? kOther : kPlain;
    compositor_.begin_interval(plain);
    background_.resize(std::size_t{size_.width} * size_.height * words_of(size_));
    fill_pixels(background_, plain, size_.format);
    before_.reset();
    left_ = random() % 3 == 0 ? 1 : 2 + random() % 4;
    alone_ = left_ == 1;
    next_ = 0;
    keyframe_parts_ = kParts;
  }

  void begin_frame(std::mt19937& random) {
    Frame*& buffer = buffers_[random() % buffers_.size()];
    std::swap(buffer, buffers_.back());
    open_.push_back({next_++, buffers_.back(), background_, kParts});
    buffers_.pop_back();
    --left_;
    compositor_.begin_frame(*open_.back().frame);
  }

  // The keyframe gets its buffer before the first strip or later; a strip's MFB must wait for it.
  void keyframe_strip(std::mt19937& random) {
    if (open_.empty() && !buffers_.empty() && (alone_ || random() % 2 == 0)) begin_frame(random);
    if (open_.empty() && (alone_ || keyframe_parts_ == 1)) return;
    Open* keyframe = open_.empty() ? nullptr : &open_.front();
    const std::uint32_t part = --keyframe_parts_;
    const Runs constant = random_runs(random, size_, part, kParts);
    if (alone_) {
      compositor_.paste_moving(*keyframe->frame, constant.runs, constant.pixels);
    } else {
      compositor_.paste_constant(constant.runs, constant.pixels, keyframe ? keyframe->frame : nullptr);
      paste(constant, size_, background_);
    }
    if (keyframe) paste(constant, size_, keyframe->twin);
    if (keyframe) paste_moving(random, *keyframe, part);
    if (keyframe_parts_ == 0) finish(open_.begin());
  }

  void inbetween_strip(std::mt19937& random, std::vector<Open>::iterator at) {
    paste_moving(random, *at, --at->parts_left);
    if (at->parts_left == 0) finish(at);
  }

  void paste_moving(std::mt19937& random, Open& open, std::uint32_t part) {
    const Runs moving = random_runs(random, size_, part, kParts);
    compositor_.paste_moving(*open.frame, moving.runs, moving.pixels);
    paste(moving, size_, open.twin);
  }

  void finish(std::vector<Open>::iterator at) {
    Frame& frame = *at->frame;
    compositor_.finish_frame(frame, at->number);
    restore_some(frame, at->twin);
    ASSERT_EQ(frame.number, at->number);
    ASSERT_EQ(frame.changed_since.has_value(), before_.has_value());
    if (before_) {
      ASSERT_EQ(frame.changed_since, before_->number);
      expect_flagged(frame, at->twin, before_->twin);
    } else {
      ASSERT_EQ(frame.changed.count(), std::uint64_t{frame.changed.rows()} * frame.changed.columns());
    }
    buffers_.push_back(at->frame);
    before_ = std::move(*at);
    open_.erase(at);
  }

  // As those do who read some lines only: others stay stale until they are read, perhaps as another frame's.
  void restore_some(Frame& frame, const Pixels& twin) {
    constexpr std::uint32_t kLines = 24;
    const std::size_t words = words_of(size_) * size_.width;
    for (std::uint32_t first = 0; first < size_.height; first += kLines) {
      const Lines lines{first, std::min(size_.height, first + kLines)};
      const auto at = static_cast<std::ptrdiff_t>(first * words), end = static_cast<std::ptrdiff_t>(lines.end * words);
      if (frame.shows_background(lines))
        ASSERT_TRUE(std::equal(twin.begin() + at, twin.begin() + end, background_.begin() + at));
      if ((frame.number + first / kLines) % 3 == 0) continue;
      frame.restore(lines);
      ASSERT_TRUE(std::equal(twin.begin() + at, twin.begin() + end, frame.pixels.begin() + at))
          << size_.width << "x" << size_.height << ", blocks of " << size_.block << ", from line " << first;
    }
  }

  static constexpr std::uint32_t kParts = 3;

  Size size_;
  std::vector<Frame*>& buffers_;
  Compositor compositor_;
  Pixels background_;
  bool alone_ = false;
  std::uint32_t next_ = 0;
  std::uint32_t left_ = 0;            // frames to begin
  std::uint32_t keyframe_parts_ = 0;  // to come
  std::vector<Open> open_;
  std::optional<Open> before_;
};

// Intervals of two compositors interleaved, in shared buffers.
void expect_twins(const Size& size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::unique_ptr<Frame>> frames;
  std::vector<Frame*> buffers;
  for (int i = 0; i < 4; ++i) {
    frames.push_back(std::make_unique<Frame>(size.width, size.height, size.block, i % 2 * kPlain, size.format));
    buffers.push_back(frames.back().get());
  }
  Twins twins[2] = {{size, buffers}, {size, buffers}};
  for (int i = 0; i < 120 && !testing::Test::HasFatalFailure(); ++i) twins[random() % 2].step(random);
}

TEST(Compositor, AsTheTwinThatDrawsFromScratch) {
  unsigned seed = 0;
  for (const std::uint32_t block : {1u, 2u, 3u, 5u, 8u, 16u, 31u, 64u, 16384u})
    for (const auto& [width, height] : {std::pair{1u, 1u}, {7u, 3u}, {64u, 64u}, {65u, 17u}, {131u, 97u}})
      for (const wire::PixelFormat format : {wire::PixelFormat::rgb8, wire::PixelFormat::half,
                                             wire::with_layers(wire::PixelFormat::half, wire::kAllLayers, 2)})
        for (int round = 0; round < 3; ++round) expect_twins({width, height, block, format}, ++seed);
}

TEST(Compositor, FramesPassFromOneToAnother) {
  Frame frame(20, 10, 4);
  Compositor first(20, 10, 4);
  Compositor second(20, 10, 4);
  first.begin_interval(1);
  second.begin_interval(2);
  const std::vector<wire::Run> runs{{3, 2, 5}};
  const Pixels pixels(5, 9);
  for (const auto& [compositor, background] : {std::pair{&first, 1u}, {&second, 2u}, {&first, 1u}}) {
    compositor->begin_frame(frame);
    compositor->finish_frame(frame, 0);
    compositor->restore(frame);
    EXPECT_EQ(frame.pixels, Pixels(200, background));
    compositor->begin_frame(frame);
    compositor->paste_moving(frame, runs, pixels);
  }
}

// What was not flagged is not written again: a pixel spoilt behind the compositor's back stays spoilt.
TEST(Compositor, RestoresFlaggedBlocksOnly) {
  Compositor compositor(64, 64, 16);
  Frame frame(64, 64, 16);
  compositor.begin_frame(frame);
  compositor.paste_moving(frame, std::vector<wire::Run>{{20, 20, 3}}, Pixels(3, 7));
  compositor.finish_frame(frame, 0);
  compositor.restore(frame);
  frame.pixels[0] = 5;
  frame.pixels[17 * 64 + 17] = 5;
  compositor.begin_frame(frame);
  compositor.finish_frame(frame, 1);
  compositor.restore(frame);
  EXPECT_EQ(frame.pixels[0], 5u);
  EXPECT_EQ(frame.pixels[17 * 64 + 17], 0u);
  EXPECT_EQ(frame.pixels[20 * 64 + 20], 0u);
  frame.pixels[17 * 64 + 17] = 5;
  compositor.begin_frame(frame);
  compositor.finish_frame(frame, 2);
  compositor.restore(frame);
  EXPECT_EQ(frame.pixels[17 * 64 + 17], 5u) << "no flag is left from the frame before";
}

// From one interval to the next only blocks with CFB of either are written, in the frame and in the saved
// background.
TEST(Compositor, RestoresWhereEitherBackgroundHasPixels) {
  Compositor compositor(64, 64, 16);
  Frame keyframe(64, 64, 16);
  Frame other(64, 64, 16);
  const auto begin = [&](std::uint16_t column) {
    compositor.begin_interval(0);
    compositor.begin_frame(keyframe);
    compositor.paste_constant(std::vector<wire::Run>{{0, column, 3}}, Pixels(3, 7), &keyframe);
    compositor.finish_frame(keyframe, 0);
    compositor.restore(keyframe);
  };
  begin(0);
  compositor.begin_frame(other);
  compositor.finish_frame(other, 1);
  compositor.restore(other);
  for (const std::size_t column : {1u, 21u, 41u}) other.pixels[64 + column] = 5;
  begin(20);
  compositor.begin_frame(other);
  compositor.finish_frame(other, 1);
  compositor.restore(other);
  EXPECT_EQ(other.pixels[0], 0u);
  EXPECT_EQ(other.pixels[20], 7u);
  EXPECT_EQ(other.pixels[64 + 1], 0u);
  EXPECT_EQ(other.pixels[64 + 21], 0u);
  EXPECT_EQ(other.pixels[64 + 41], 5u);
  EXPECT_EQ(other.constant.count(), 1u);
}

// The next interval's background is another; a buffer of the interval before shows it everywhere.
TEST(Compositor, EachIntervalHasItsPlainBackground) {
  Compositor compositor(20, 10, 4, wire::PixelFormat::rgb16);
  Frame frame(20, 10, 4, 0, wire::PixelFormat::rgb16);
  for (const std::uint64_t plain : {kPlain, kOther}) {
    compositor.begin_interval(plain);
    compositor.begin_frame(frame);
    compositor.paste_constant(std::vector<wire::Run>{{3, 2, 1}}, Pixels{7, 8}, &frame);
    compositor.finish_frame(frame, 0);
    compositor.restore(frame);
    Pixels expected(400);
    fill_pixels(expected, plain, wire::PixelFormat::rgb16);
    expected[2 * 62] = 7;
    expected[2 * 62 + 1] = 8;
    EXPECT_EQ(frame.pixels, expected);
  }
}

// Who has looked at the background of an interval in which nothing stood still must not take the next one's for it.
TEST(Compositor, AnIntervalThatShowsSomethingHasABackgroundOfItsOwn) {
  Compositor compositor(20, 10, 4);
  Frame empty(20, 10, 4), full(20, 10, 4);
  compositor.begin_interval(kPlain);
  compositor.begin_frame(empty);
  compositor.finish_frame(empty, 0);
  const std::shared_ptr<const Background> plain = empty.shown;
  compositor.begin_interval(kPlain);
  compositor.begin_frame(full);
  EXPECT_EQ(full.shown, plain);
  compositor.paste_constant(std::vector<wire::Run>{{3, 2, 1}}, Pixels{7}, &full);
  compositor.finish_frame(full, 1);
  EXPECT_NE(full.shown, plain);
  compositor.begin_frame(empty);
  EXPECT_EQ(empty.shown, full.shown);
}

TEST(Compositor, AKeyframeThatMissedPixelsIsABug) {
  Compositor compositor(64, 64, 16);
  Frame frame(64, 64, 16);
  const std::vector<wire::Run> runs{{0, 0, 1}};
  compositor.paste_constant(runs, Pixels{7}, nullptr);
  compositor.begin_frame(frame);
  compositor.paste_constant(runs, Pixels{7}, nullptr);
  EXPECT_THROW(compositor.paste_constant(runs, Pixels{7}, &frame), std::logic_error);
}

TEST(Compositor, TellsWhatChangedSinceTheFrameBefore) {
  Compositor compositor(64, 64, 16);
  Frame frame(64, 64, 16);
  for (std::uint32_t number = 0; number < 2; ++number) {
    compositor.begin_frame(frame);
    const std::vector<wire::Run> runs{{number * 40, static_cast<std::uint16_t>(number * 40), 1}};
    compositor.paste_moving(frame, runs, Pixels{7});
    compositor.finish_frame(frame, number);
    compositor.restore(frame);
  }
  EXPECT_EQ(frame.changed_since, 0u);
  EXPECT_EQ(frame.changed.count(), 2u);
  EXPECT_TRUE(frame.changed.at(0, 0));
  EXPECT_TRUE(frame.changed.at(2, 2));
}

TEST(Compositor, WrongStripsAreFailuresAndLeaveThePictureAlone) {
  Compositor compositor(10, 5, 4);
  Frame frame(10, 5, 4);
  compositor.begin_frame(frame);
  const Pixels pixels(3, 7);
  const auto wrong = [&](wire::Run run) {
    const std::vector<wire::Run> runs{{0, 0, 0}, run};
    const std::span<const wire::Run> one = std::span(runs).subspan(1);
    const std::string moving = document::failure_of([&] { compositor.paste_moving(frame, one, pixels); });
    EXPECT_EQ(moving, document::failure_of([&] { compositor.paste_constant(one, pixels, &frame); }));
    return moving;
  };
  EXPECT_TRUE(document::holds(wrong({5, 0, 3}), "3 pixels from column 0 of line 5"));
  EXPECT_TRUE(document::holds(wrong({0, 8, 3}), "outside the picture"));
  EXPECT_TRUE(document::holds(wrong({0xffffffff, 0xffff, 0xffff}), "outside the picture"));
  EXPECT_TRUE(document::holds(wrong({0, 0, 0}), "0 pixels"));
  EXPECT_TRUE(document::holds(wrong({0, 0, 2}), "has 3 pixels where its runs count 2"));
  EXPECT_TRUE(document::holds(wrong({0, 0, 4}), "has 3 pixels where its runs count 4"));
  EXPECT_EQ(frame.pixels, Pixels(50, 0));
}

TEST(Compositor, CountsWhatItPastedAndRestored) {
  constexpr std::uint32_t kWidth = 32, kHeight = 16, kBlock = 8;
  Compositor compositor(kWidth, kHeight, kBlock);
  Frame frame(kWidth, kHeight, kBlock);
  const std::vector<wire::Run> one{{0, 3, 5}};
  const std::vector<std::uint32_t> pixels(5, 7);
  compositor.begin_interval(0);
  compositor.begin_frame(frame);
  compositor.paste_moving(frame, one, pixels);
  compositor.finish_frame(frame, 0);
  compositor.restore(frame);
  const PastedCounts first = compositor.take_counts();
  EXPECT_EQ(first.runs, 1u);
  EXPECT_EQ(first.bytes, 5 * sizeof(std::uint32_t));
  EXPECT_EQ(first.restored, 0u);
  compositor.begin_frame(frame);
  compositor.finish_frame(frame, 1);
  compositor.restore(frame);
  const PastedCounts second = compositor.take_counts();
  EXPECT_EQ(second.runs, 0u);
  EXPECT_EQ(second.restored, kBlock * kBlock * sizeof(std::uint32_t));  // the block under the run
}

}  // namespace
}  // namespace mars::compositor
