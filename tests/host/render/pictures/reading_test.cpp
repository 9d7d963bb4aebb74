#include "host/render/pictures/reading.h"

#include <gtest/gtest.h>

#include <functional>

namespace mars::pictures {
namespace {

constexpr std::uint32_t kWidth = 6, kHeight = 4;
constexpr Begin kRendering{kWidth, kHeight, 2, 1, 9, 0};
constexpr Begin kViews{kWidth, kHeight, 2, 1, 0, 0};

Message message_of(Head head, const Body& body) {
  head.bytes = body->size();
  return {head, *body};
}

Picture sound_picture() {
  Picture picture{3, 7, {}, {{0, 0, 2, 2}, {4, 1, 2, 3}}, std::vector<Line>(kHeight, Line{1, 5}), {}};
  picture.head.width = kWidth;
  picture.head.height = kHeight;
  for (std::uint32_t pixel = 0; pixel < 10; ++pixel) picture.pixels.push_back(0x03000000u + pixel);
  return picture;
}

Message message_of(const Picture& picture) {
  return message_of({Kind::picture, picture.view, picture.picture}, body_of_picture(picture));
}

std::string refusal_of(const std::function<void()>& work) try {
  work();
  return "";
} catch (const Malformed& failure) {
  return failure.problem;
}

TEST(Reading, PicturesAreAsTheyWereSent) {
  const Picture sent = sound_picture();
  const Picture read = read_picture(message_of(sent), kRendering);
  EXPECT_EQ(read.view, 3u);
  EXPECT_EQ(read.picture, 7u);
  EXPECT_EQ(read.rects, sent.rects);
  EXPECT_EQ(read.pixels, sent.pixels);
  ASSERT_EQ(read.lines.size(), kHeight);
  EXPECT_EQ(read.lines.back().edge_boxes, 5u);
}

TEST(Reading, OtherMessagesAreAsTheyWereSent) {
  std::vector<wire::Hello> hellos(2);
  hellos[1].machine = 1;
  hellos[1].host = {"n1"};
  const BeginMessage begin = read_begin(message_of({Kind::begin}, body_of_begin(kRendering, hellos)));
  EXPECT_EQ(begin.begin.frames, 9u);
  ASSERT_EQ(begin.nodes.size(), 2u);
  EXPECT_EQ(begin.nodes[1].machine, 1);
  EXPECT_STREQ(begin.nodes[1].host.data(), "n1");

  Part part{};
  part.node = 2;
  const std::vector<Part> parts(3, part);
  const DrawnMessage drawn = read_drawn(message_of({Kind::drawn}, body_of(DrawnHead{.frame = 5, .parts = 3}, parts)));
  EXPECT_EQ(drawn.head.frame, 5u);
  EXPECT_EQ(drawn.parts.at(2).node, 2);
}

TEST(Reading, MessagesOfWindowsAreAsTheyWereSent) {
  const Key key = read_key(message_of({Kind::key}, body_of(Key{SpecialKey::none, 'q'})));
  EXPECT_EQ(key.character, std::uint32_t{'q'});
  EXPECT_EQ(read_key(message_of({Kind::key}, body_of(Key{SpecialKey::home, 0}))).special, SpecialKey::home);
  EXPECT_EQ(read_space(message_of({Kind::space}, body_of(Space{640, 360}))).height, 360u);
  EXPECT_EQ(read_caption(message_of({Kind::caption}, body_of(std::string("a title")))), "a title");
}

TEST(Reading, DamagedMessagesOfWindowsAreRefused) {
  const auto refused = [](const Key& key) {
    return !refusal_of([&] { read_key(message_of({Kind::key}, body_of(key))); }).empty();
  };
  EXPECT_TRUE(refused({SpecialKey::none, 0}));
  EXPECT_TRUE(refused({SpecialKey::none, 128}));
  EXPECT_TRUE(refused({SpecialKey::up, 'q'}));
  EXPECT_TRUE(refused({static_cast<SpecialKey>(9), 0}));
  for (const Space& space : {Space{0, 1}, Space{1, wire::kMaxSide + 1}})
    EXPECT_NE(refusal_of([&] { read_space(message_of({Kind::space}, body_of(space))); }), "");
  EXPECT_NE(refusal_of([] { check_head({.kind = Kind::key, .bytes = sizeof(Key)}, Sender::host); }), "");
  EXPECT_NE(refusal_of([] { check_head({.kind = Kind::begin, .bytes = sizeof(Begin)}, Sender::window); }), "");
  EXPECT_NE(refusal_of([] { check_head({.kind = Kind::space, .bytes = 3}, Sender::window); }), "");
}

TEST(Reading, DamagedPicturesAreRefused) {
  const auto refusal = [](const std::function<void(Picture&)>& damage, const std::optional<Begin>& begin = kRendering) {
    Picture picture = sound_picture();
    damage(picture);
    return refusal_of([&] { read_picture(message_of(picture), begin); });
  };
  const auto none = [](Picture&) {};
  EXPECT_EQ(refusal(none), "");
  EXPECT_NE(refusal(none, std::nullopt).find("before it has begun"), std::string::npos);
  EXPECT_NE(refusal(none, kViews).find("not of its film"), std::string::npos) << "views have no lines";
  EXPECT_EQ(refusal([](Picture& p) { p.lines.clear(); }, kViews), "");
  EXPECT_NE(refusal([](Picture& p) { p.lines.pop_back(); }), "");
  EXPECT_NE(refusal([](Picture& p) { p.head.width = 0; }), "");
  EXPECT_NE(refusal([](Picture& p) { p.head.height = wire::kMaxSide + 1; }), "");
  EXPECT_NE(refusal([](Picture& p) { p.head.kind = static_cast<wire::FrameKind>(2); }), "");
  EXPECT_NE(refusal([](Picture& p) { p.rects[1].x = 5; }).find("outside"), std::string::npos);
  EXPECT_NE(refusal([](Picture& p) { p.rects[0].height = 0; }), "");
  EXPECT_NE(refusal([](Picture& p) { p.rects.assign(9, {0, 0, 6, 4}); }).find("more pixels"), std::string::npos);
  EXPECT_NE(refusal([](Picture& p) { p.pixels.pop_back(); }).find("size"), std::string::npos);
  EXPECT_NE(refusal([](Picture& p) { p.pixels.push_back(0); }).find("size"), std::string::npos);
}

// A count that promises more than has come makes no memory.
TEST(Reading, CountsAreCheckedAgainstWhatCame) {
  Message picture = message_of(sound_picture());
  const std::uint32_t many = 0xffffffff;
  memcpy(picture.body.data() + offsetof(PictureHead, rects), &many, sizeof many);
  EXPECT_NE(refusal_of([&] { read_picture(picture, kRendering); }), "");
  Begin begin = kRendering;
  begin.nodes = many;
  EXPECT_NE(refusal_of([&] { read_begin(message_of({Kind::begin}, body_of(begin))); }), "");
  EXPECT_NE(refusal_of([&] { read_drawn(message_of({Kind::drawn}, body_of(DrawnHead{.parts = many}))); }), "");
  EXPECT_NE(refusal_of([&] { read_drawn({{Kind::drawn}, std::vector<std::byte>(3)}); }), "");
}

TEST(Reading, HeadsAreOfTheirSender) {
  const auto refusal = [](const Head& head, Sender sender) { return refusal_of([&] { check_head(head, sender); }); };
  EXPECT_EQ(refusal({Kind::close, 1}, Sender::studio), "");
  EXPECT_NE(refusal({Kind::close, 1}, Sender::host).find("the host sends a message of no known kind"),
            std::string::npos);
  EXPECT_EQ(refusal({Kind::dropped, 1, 2}, Sender::host), "");
  EXPECT_NE(refusal({Kind::dropped, 1, 2}, Sender::studio), "");
  EXPECT_NE(refusal({Kind::dropped, 1, 2, 0, 8}, Sender::host), "");
  EXPECT_NE(refusal({Kind::picture, 0, 0, 0, sizeof(PictureHead) - 1}, Sender::host), "");
  EXPECT_NE(refusal({Kind::picture, 0, 0, 0, std::uint64_t{1} << 40}, Sender::host), "");
}

TEST(Reading, WhatIsCutAndPastedIsTheSame) {
  std::vector<std::uint32_t> whole(kWidth * kHeight);
  for (std::uint32_t pixel = 0; pixel < whole.size(); ++pixel) whole[pixel] = 0xff000000u + pixel;
  const std::vector<Rect> rects{{1, 0, 3, 2}, {0, 3, 6, 1}};
  const std::vector<std::uint32_t> cut = cut_opaque(whole, kWidth, rects);
  EXPECT_EQ(cut.size(), pixels_in(rects));
  std::vector<std::uint32_t> other(whole.size());
  paste(cut, rects, kWidth, other);
  EXPECT_EQ(cut_opaque(other, kWidth, rects), cut);
  EXPECT_EQ(other[kWidth + 3], whole[kWidth + 3]);
  EXPECT_EQ(other[kWidth + 4], 0u);
}

}  // namespace
}  // namespace mars::pictures
