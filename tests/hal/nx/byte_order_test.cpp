#include "hal/nx/byte_order.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include <gtest/gtest.h>

#include "hal/nx/nx_byte_order.h"

namespace mars::nx {
namespace {

constexpr std::endian kOther = std::endian::native == std::endian::little ? std::endian::big : std::endian::little;

TEST(ByteOrder, BytesTurnRoundWhereOrdersDiffer) {
  std::array<std::uint16_t, 2> shorts{0x0102, 0xa0b0};
  reorder(std::span<std::remove_reference_t<decltype(shorts[0])>>(shorts), std::endian::little, std::endian::big);
  EXPECT_EQ(shorts, (std::array<std::uint16_t, 2>{0x0201, 0xb0a0}));
  std::array<std::uint32_t, 1> words{0x01020304};
  reorder(std::span<std::remove_reference_t<decltype(words[0])>>(words), std::endian::big, std::endian::little);
  EXPECT_EQ(words[0], 0x04030201u);
  // 1.0 is 3f f0 and six zeros.
  double one = 1;
  reorder(std::span<double>(&one, 1), std::endian::native, kOther);
  std::uint64_t bits = 0;
  std::memcpy(&bits, &one, sizeof bits);
  EXPECT_EQ(bits, 0xf03fu);
  reorder(std::span<double>(&one, 1), kOther, std::endian::native);
  EXPECT_EQ(one, 1);
}

TEST(ByteOrder, EqualOrdersLeaveEverything) {
  std::array<float, 2> floats{1.5f, -2.25f};
  reorder(std::span<std::remove_reference_t<decltype(floats[0])>>(floats), std::endian::big, std::endian::big);
  EXPECT_EQ(floats, (std::array<float, 2>{1.5f, -2.25f}));
}

TEST(ByteOrder, HostAndNodesAreOfOneKind) {
  short s = 0x0102;
  long l = 0x01020304;
  float f = 1.5f;
  double d = -2.5;
  htocs(&s, 1), htocl(&l, 1), htocf(&f, 1), htocd(&d, 1);
  EXPECT_TRUE(s == 0x0102 && l == 0x01020304 && f == 1.5f && d == -2.5);
  ctohs(&s, 1), ctohl(&l, 1), ctohf(&f, 1), ctohd(&d, 1);
  EXPECT_TRUE(s == 0x0102 && l == 0x01020304 && f == 1.5f && d == -2.5);
}

}  // namespace
}  // namespace mars::nx
