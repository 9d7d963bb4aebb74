// Pictures and texts on their way to a page: what waits, what is replaced, how pictures are encoded, and that in the
// end the page has the pixels that it should have.
#include "host/studio/web/page_outbox.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>
#include <zlib.h>

#include <cstdlib>
#include <cstring>
#include <random>

namespace mars::web {
namespace {

using studio::ViewPicture;
using namespace std::chrono_literals;
using Time = PageOutbox::Time;

struct Received {
  std::uint32_t magic, view, picture, edit_low, edit_high;
  std::uint16_t width, height, encoding, flags;
  std::uint32_t rect_count;
};

ViewPicture picture_of(std::uint32_t number, pictures::Rect rect, bool rests, std::uint32_t color) {
  ViewPicture picture;
  picture.page = 1;
  picture.view = 2;
  picture.picture = number;
  picture.edit = (std::uint64_t{5} << 32) + number;
  picture.width = 320;
  picture.height = 200;
  picture.rests = picture.exact = rests;  // as the stage says it
  picture.rects = {rect};
  for (std::uint32_t i = 0; i < std::uint32_t{rect.width} * rect.height; ++i)
    picture.pixels.push_back(0xff000000u | color | (i % 7 == 0 ? 0x40 : 0));
  return picture;
}

ViewPicture whole(std::uint32_t number, bool rests, std::uint32_t color) {
  return picture_of(number, {0, 0, 320, 200}, rests, color);
}

// What a page does with its messages.
class Page {
 public:
  // The encoding.
  Encoding take(const std::string& bytes) {
    std::memcpy(&last, bytes.data(), sizeof(last));
    EXPECT_EQ(last.magic, 0x5352414du);
    std::vector<pictures::Rect> rects(last.rect_count);
    const std::size_t head = sizeof(last) + rects.size() * sizeof(pictures::Rect);
    std::memcpy(rects.data(), bytes.data() + sizeof(last), head - sizeof(last));
    const auto encoding = static_cast<Encoding>(last.encoding);
    std::size_t count = 0;
    for (const pictures::Rect& rect : rects) count += std::size_t{rect.width} * rect.height;
    paint(rects, decoded(encoding, bytes.substr(head), count));
    return encoding;
  }

  std::vector<std::uint32_t> screen;
  Received last{};

 private:
  std::vector<std::uint32_t> decoded(Encoding encoding, const std::string& body, std::size_t count) const {
    std::vector<std::uint32_t> pixels(count);
    auto* out = reinterpret_cast<unsigned char*>(pixels.data());
    const auto* in = reinterpret_cast<const unsigned char*>(body.data());
    uLongf bytes = count * 4;
    if (encoding == Encoding::raw) {
      EXPECT_EQ(body.size(), bytes);
      std::memcpy(out, in, bytes);
    } else if (encoding == Encoding::deflate) {
      EXPECT_EQ(uncompress(out, &bytes, in, body.size()), Z_OK);
      EXPECT_EQ(bytes, count * 4);
    } else {
      const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), &tjDestroy);
      EXPECT_EQ(tjDecompress2(decoder.get(), in, body.size(), out, last.width, 0, last.height, TJPF_RGBX, 0), 0);
    }
    return pixels;
  }

  void paint(const std::vector<pictures::Rect>& rects, const std::vector<std::uint32_t>& pixels) {
    screen.resize(std::size_t{last.width} * last.height);
    pictures::paste(pixels, rects, last.width, screen);
  }
};

class PageOutboxTest : public testing::Test {
 protected:
  Json painted(std::uint32_t picture) { return {{"do", "painted"}, {"view", 2}, {"picture", picture}}; }

  // The next message, a picture, painted after `later`.
  Encoding receive(std::chrono::milliseconds later) {
    const auto outgoing = outbox_.next(now_);
    EXPECT_TRUE(outgoing && !outgoing->is_text);
    const Encoding encoding = page_.take(outgoing->bytes);
    now_ += later;
    outbox_.hear(painted(page_.last.picture), now_);
    return encoding;
  }

  // A link of half a megabyte a second.
  void make_slow() {
    for (std::uint32_t i = 0; i < 6; ++i) {
      outbox_.show(picture_of(100 + i, {0, 0, 320, 20}, true, i), now_);
      receive(i == 0 ? 1ms : 800ms);
    }
    ASSERT_LT(outbox_.speed().bytes_a_second(), 1e6);
  }

  PageOutbox outbox_;
  Page page_;
  Time now_ = Time{} + 1h;
};

TEST_F(PageOutboxTest, TwoPicturesAreOnTheWayAtMost) {
  for (std::uint32_t i = 1; i <= 3; ++i) outbox_.show(whole(i, true, i), now_);
  EXPECT_TRUE(outbox_.next(now_));
  EXPECT_TRUE(outbox_.next(now_));
  EXPECT_FALSE(outbox_.next(now_));
  EXPECT_FALSE(outbox_.hear(painted(7), now_)) << "never sent";
  EXPECT_FALSE(outbox_.next(now_));
  EXPECT_TRUE(outbox_.hear(painted(1), now_));
  EXPECT_FALSE(outbox_.hear(painted(1), now_)) << "twice";
  EXPECT_TRUE(outbox_.next(now_));
  EXPECT_TRUE(outbox_.hear(painted(3), now_)) << "with those before";
  EXPECT_FALSE(outbox_.next(now_));
}

TEST_F(PageOutboxTest, TheNewestTextReplacesOlderOnes) {
  outbox_.tell({{"is", "poses"}, {"n", 1}});
  outbox_.tell({{"is", "remark"}, {"n", 2}});
  outbox_.tell({{"is", "poses"}, {"n", 3}});
  outbox_.tell({{"is", "remark"}, {"n", 4}});
  std::string all;
  while (const auto next = outbox_.next(now_)) all += next->bytes;
  EXPECT_EQ(all, R"({"is":"poses","n":3}{"is":"remark","n":2}{"is":"remark","n":4})");
}

TEST_F(PageOutboxTest, HandlesComeBeforeTheirPicture) {
  ViewPicture picture = whole(1, true, 1);
  picture.handles = Json::array({{{"id", 4}}});
  outbox_.show(std::move(picture), now_);
  const auto first = outbox_.next(now_);
  ASSERT_TRUE(first && first->is_text);
  EXPECT_EQ(first->bytes, R"({"is":"handles","view":2,"picture":1,"shapes":[{"id":4}]})");
  receive(1ms);
  EXPECT_EQ(page_.last.picture, 1u);
  EXPECT_EQ(page_.last.edit_low, 1u);
  EXPECT_EQ(page_.last.edit_high, 5u);
}

TEST_F(PageOutboxTest, HandlesOfAPictureThatWaitsGiveWayToNewerOnes) {
  ViewPicture picture = whole(1, true, 1);
  picture.handles = Json::array({{{"id", 4}}});
  outbox_.show(std::move(picture), now_);
  outbox_.tell({{"is", "handles"}, {"view", 2}, {"picture", 1}, {"shapes", Json::array({{{"id", 5}}})}});
  const auto first = outbox_.next(now_);
  ASSERT_TRUE(first && first->is_text);
  EXPECT_EQ(Json::parse(first->bytes)["shapes"][0]["id"], 5);
  receive(1ms);
}

TEST_F(PageOutboxTest, FastLinksGetRawPictures) {
  Encoding encoding = Encoding::deflate;
  std::mt19937 random(3);
  for (std::uint32_t i = 1; i <= 10; ++i) {
    ViewPicture picture = whole(i, false, i);
    for (std::uint32_t& pixel : picture.pixels) pixel = 0xff000000u | random();
    outbox_.show(picture, now_);
    encoding = receive(4ms);
    EXPECT_EQ(page_.screen, picture.pixels);
    EXPECT_EQ(page_.last.flags, 0u);
  }
  EXPECT_EQ(encoding, Encoding::raw);
}

TEST_F(PageOutboxTest, SmallPicturesAreRawUntilTheLinkIsSlow) {
  const pictures::Rect largest_small{0, 0, 256, 32};
  for (std::uint32_t i = 1; i <= 10; ++i) {
    outbox_.show(picture_of(i, {0, 0, 64, 20}, true, i), now_);
    EXPECT_EQ(receive(4ms), Encoding::raw);
  }
  outbox_.show(picture_of(11, largest_small, true, 1), now_);
  EXPECT_EQ(receive(4ms), Encoding::raw);
  outbox_.show(picture_of(12, {0, 0, 256, 33}, true, 1), now_);
  EXPECT_EQ(receive(4ms), Encoding::deflate);
  make_slow();
  outbox_.show(picture_of(13, largest_small, true, 1), now_);
  EXPECT_EQ(receive(4ms), Encoding::deflate);
}

TEST_F(PageOutboxTest, OneLateSmallPictureDoesNotMakeALinkSlow) {
  for (std::uint32_t i = 1; i <= 4; ++i) {
    outbox_.show(picture_of(i, {0, 0, 64, 20}, true, i), now_);
    EXPECT_EQ(receive(i == 2 ? 60ms : 4ms), Encoding::raw);
  }
}

TEST_F(PageOutboxTest, SlowLinksGetLossyPicturesUntilTheyRest) {
  make_slow();
  outbox_.show(whole(200, false, 0x3050), now_);
  EXPECT_EQ(receive(100ms), Encoding::jpeg);
  EXPECT_EQ(page_.last.flags, 0u);
  EXPECT_NE(page_.screen, whole(1, true, 0x3050).pixels);
  EXPECT_FALSE(outbox_.next(now_)) << "it moves";
  ASSERT_TRUE(outbox_.due());
  now_ = *outbox_.due();
  int bands = 0;
  for (; outbox_.due(); ++bands) EXPECT_EQ(receive(50ms), Encoding::deflate);
  EXPECT_GT(bands, 1);
  EXPECT_EQ(page_.screen, whole(1, true, 0x3050).pixels);
  EXPECT_EQ(page_.last.flags, 0u) << "all its pixels, but a hand may go on";
  EXPECT_EQ(page_.last.picture, 200u);
  EXPECT_FALSE(outbox_.next(now_ + 1h));
}

TEST_F(PageOutboxTest, WhatChangesInALossyPictureIsExactInTheEnd) {
  make_slow();
  outbox_.show(whole(200, false, 0x3050), now_);
  receive(100ms);
  outbox_.show(picture_of(201, {16, 32, 64, 16}, true, 0x807060), now_);
  EXPECT_EQ(receive(10ms), Encoding::raw);
  EXPECT_EQ(page_.last.flags, 1u) << "it rests, but all around it is lossy";
  while (outbox_.due()) receive(50ms);
  std::vector<std::uint32_t> expected = whole(1, true, 0x3050).pixels;
  const ViewPicture change = picture_of(201, {16, 32, 64, 16}, true, 0x807060);
  for (std::uint32_t i = 0; i < 64 * 16; ++i) expected[(32 + i / 64) * 320 + 16 + i % 64] = change.pixels[i];
  EXPECT_EQ(page_.screen, expected);
  EXPECT_EQ(page_.last.flags, 3u);
}

TEST_F(PageOutboxTest, NewerPicturesGoBeforeTheBands) {
  make_slow();
  outbox_.show(whole(200, false, 0x3050), now_);
  receive(100ms);
  now_ += 200ms;
  receive(50ms);  // a band
  outbox_.show(whole(201, false, 0x99), now_);
  EXPECT_EQ(receive(100ms), Encoding::jpeg);
  outbox_.show(whole(202, true, 0x77), now_);
  EXPECT_EQ(receive(500ms), Encoding::deflate);
  EXPECT_EQ(page_.screen, whole(1, true, 0x77).pixels);
  EXPECT_FALSE(outbox_.due());
}

TEST_F(PageOutboxTest, TheStageHearsNothingOfBands) {
  make_slow();
  outbox_.show(whole(200, false, 0x3050), now_);
  receive(100ms);
  now_ += 200ms;
  ASSERT_TRUE(outbox_.next(now_));
  EXPECT_FALSE(outbox_.hear(painted(200), now_ + 10ms));
}

TEST_F(PageOutboxTest, APageThatTakesNothingOverflows) {
  for (std::uint32_t i = 1; i <= 16; ++i) outbox_.show(picture_of(i, {0, 0, 8, 8}, true, i), now_);
  EXPECT_FALSE(outbox_.overflows());
  outbox_.show(picture_of(17, {0, 0, 8, 8}, true, 17), now_);
  EXPECT_TRUE(outbox_.overflows());
  outbox_.hear({{"do", "unview"}, {"view", 2}}, now_);
  EXPECT_FALSE(outbox_.overflows());
  for (int i = 0; i < 20; ++i) outbox_.tell({{"is", "remark"}, {"text", std::string(1 << 20, 'x')}});
  EXPECT_TRUE(outbox_.overflows());
}

}  // namespace
}  // namespace mars::web
