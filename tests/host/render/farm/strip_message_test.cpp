#include "host/render/farm/strip_message.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/host/render/farm/strips.h"

namespace mars::farm {
namespace {

using wire::PixelFormat;

wire::Strip keyframe_strip() {
  wire::Strip strip{};
  strip.kind = wire::FrameKind::keyframe;
  strip.by_message = 1;
  return strip;
}

const Runs kConstant{{{0, 1, 2}, {1, 0, 1}}, {10, 11, 12}};
const Runs kMoving{{{1, 1, 1}}, {20}};

void expect_parts(const StripMessage& strip) {
  EXPECT_EQ(strip.runs().size(), 3u);
  EXPECT_EQ(strip.pixels().size(), 4u);
  ASSERT_EQ(strip.constant_runs().size(), 2u);
  EXPECT_EQ(strip.constant_runs()[1].line, 1u);
  EXPECT_EQ(strip.constant_pixels()[2], 12u);
  ASSERT_EQ(strip.moving_runs().size(), 1u);
  EXPECT_EQ(strip.moving_runs()[0].first, 1u);
  ASSERT_EQ(strip.moving_pixels().size(), 1u);
  EXPECT_EQ(strip.moving_pixels()[0], 20u);
}

TEST(StripMessage, HasItsPartsInPlace) {
  StripStore store;
  expect_parts(*StripMessage::read(strip_bytes(keyframe_strip(), kConstant, kMoving, store), PixelFormat::rgb8));
}

TEST(StripMessage, PixelsMayHaveTwoWords) {
  StripStore store;
  const Runs constant{{{0, 1, 2}}, {10, 11, 12, 13}}, moving{{{1, 1, 1}}, {20, 21}};
  const auto bytes = [&] { return strip_bytes(keyframe_strip(), constant, moving, store, PixelFormat::half); };
  const StripMessage strip = *StripMessage::read(bytes(), PixelFormat::half);
  EXPECT_EQ(strip.header().pixels, 3u);
  EXPECT_TRUE(std::ranges::equal(strip.constant_pixels(), constant.pixels));
  EXPECT_TRUE(std::ranges::equal(strip.moving_pixels(), moving.pixels));
  EXPECT_EQ(strip.moving_runs()[0].line, 1u);
  EXPECT_FALSE(StripMessage::read(bytes(), PixelFormat::rgb8)) << "of another size";
}

TEST(StripMessage, OtherThanItsHeaderSaysIsNone) {
  StripStore store;
  const auto is_none = [&](const auto& spoil) {
    StripBytes bytes = strip_bytes(keyframe_strip(), kConstant, kMoving, store);
    spoil(bytes, *reinterpret_cast<wire::Strip*>(bytes.data.get()));
    return !StripMessage::read(std::move(bytes), PixelFormat::rgb8);
  };
  EXPECT_FALSE(is_none([](StripBytes&, wire::Strip&) {}));
  EXPECT_TRUE(is_none([](StripBytes& bytes, wire::Strip&) { bytes.size = sizeof(wire::Strip) - 1; }));
  EXPECT_TRUE(is_none([](StripBytes& bytes, wire::Strip&) { bytes.size -= 1; }));
  EXPECT_TRUE(is_none([](StripBytes&, wire::Strip& strip) { strip.pixels = ~std::uint64_t{0} / 4; }));
  EXPECT_TRUE(is_none([](StripBytes&, wire::Strip& strip) { strip.constant_runs = 0xffffffff; }));
  EXPECT_TRUE(is_none([](StripBytes&, wire::Strip& strip) { strip.kind = wire::FrameKind::inbetween; }));
  EXPECT_TRUE(is_none([](StripBytes&, wire::Strip& strip) { strip.kind = static_cast<wire::FrameKind>(2); }));
  // As many bytes, but a pixel's are taken for half a run's.
  EXPECT_TRUE(is_none([](StripBytes&, wire::Strip& strip) { strip.pixels += 2, strip.moving_runs -= 1; }));
  EXPECT_TRUE(is_none([](StripBytes&, wire::Strip& strip) { strip.by_message = 0; }));
}

// A strip in a slot, and its header as it came.
struct InSlot {
  InSlot() : bytes(wire::kSlotBytes) {
    wire::Strip strip = keyframe_strip();
    strip.by_message = 0;
    const StripBytes whole = strip_bytes(strip, kConstant, kMoving, store);
    std::copy_n(whole.data.get(), whole.size, bytes.begin());
    std::memcpy(&header, bytes.data(), sizeof header);
  }
  std::optional<StripMessage> read() { return StripMessage::read(header, bytes, PixelFormat::rgb8, store); }

  StripStore store;
  std::vector<std::byte> bytes;
  wire::Strip header;
};

TEST(StripInSlot, HasItsPartsInPlace) {
  InSlot slot;
  const StripMessage strip = *slot.read();
  expect_parts(strip);
  const auto* pixels = reinterpret_cast<const std::byte*>(strip.pixels().data());
  EXPECT_EQ(pixels, slot.bytes.data() + sizeof(wire::Strip)) << "where the node wrote them";
}

// Whatever its node writes there later.
TEST(StripInSlot, DependsOnNothingButPixelsOfTheSlot) {
  InSlot slot;
  const StripMessage strip = *slot.read();
  std::ranges::fill(slot.bytes, std::byte{0xff});
  EXPECT_EQ(strip.pixels().size(), 4u);
  EXPECT_EQ(strip.constant_pixels().size(), 3u);
  EXPECT_EQ(strip.header().moving_runs, 1u);
  ASSERT_EQ(strip.runs().size(), 3u);
  EXPECT_EQ(strip.runs()[1].line, 1u);
  EXPECT_EQ(strip.runs()[2].count, 1u);
}

TEST(StripInSlot, OtherThanItsHeaderSaysIsNone) {
  const auto is_none = [](const auto& spoil) {
    InSlot slot;
    spoil(slot.header, slot.bytes);
    return !slot.read();
  };
  using Slot = std::vector<std::byte>;
  EXPECT_FALSE(is_none([](wire::Strip&, Slot&) {}));
  EXPECT_TRUE(is_none([](wire::Strip& header, Slot&) { header.by_message = 1; }));
  EXPECT_TRUE(is_none([](wire::Strip& header, Slot&) { header.kind = wire::FrameKind::inbetween; }));
  EXPECT_TRUE(is_none([](wire::Strip& header, Slot&) { header.pixels = wire::kMaxStripBytes / 4; }));
  EXPECT_TRUE(is_none([](wire::Strip& header, Slot&) { header.pixels = ~std::uint64_t{0} / 4; }));
  EXPECT_TRUE(is_none([](wire::Strip& header, Slot&) { header.moving_runs = 0xffffffff; }));
  EXPECT_TRUE(is_none([](wire::Strip& header, Slot&) { ++header.pixels; }));
  EXPECT_TRUE(is_none([](wire::Strip& header, Slot& slot) {
    const wire::Run run{0, 1, 3};
    std::memcpy(slot.data() + sizeof header + 4 * header.pixels, &run, sizeof run);
  })) << "a run of another length";
}

TEST(StripStore, UsesMemoryAgain) {
  StripStore store;
  std::set<const std::byte*> used;
  for (int frame = 0; frame < 100; ++frame) {
    std::vector<StripBytes> held;
    // Sizes grow at first and vary then; three are in use at a time.
    for (const std::size_t size : {100u, 900u + frame % 7u, 500u + frame % 3u}) {
      held.push_back(store.take(size));
      EXPECT_EQ(held.back().size, size);
      EXPECT_GE(held.back().capacity, size);
      std::fill_n(held.back().data.get(), size, std::byte{1});
    }
    std::set<const std::byte*> now;
    for (StripBytes& bytes : held) now.insert(bytes.data.get());
    EXPECT_EQ(now.size(), 3u);
    if (frame >= 3) used.insert(now.begin(), now.end());
    for (StripBytes& bytes : held) store.give_back(std::move(bytes));
  }
  EXPECT_EQ(used.size(), 3u) << "new memory was made when there was some to use";
}

}  // namespace
}  // namespace mars::farm
