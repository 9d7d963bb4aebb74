// changed_frames.cpp compares structs of a film bit by bit: none may have padding, whose bits are anything.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "node/wire/film_parts.h"

namespace mars::film {
namespace {

#ifdef __has_builtin
#if __has_builtin(__builtin_clear_padding)
#define MARS_CAN_CLEAR_PADDING 1
#endif
#endif

#ifdef MARS_CAN_CLEAR_PADDING

template <typename T>
bool has_padding() {
  T object{};
  std::memset(static_cast<void*>(&object), 0xff, sizeof object);
  __builtin_clear_padding(&object);
  std::array<unsigned char, sizeof object> bytes;
  std::memcpy(bytes.data(), &object, sizeof object);
  return std::ranges::count(bytes, 0xff) < static_cast<std::ptrdiff_t>(sizeof object);
}

struct Padded {
  float number;
  std::uint8_t flag;
};

TEST(Padding, IsInNoStructThatIsComparedBitByBit) {
  EXPECT_TRUE(has_padding<Padded>());
  EXPECT_FALSE(has_padding<wire::Camera>());
  EXPECT_FALSE(has_padding<wire::Light>());
  EXPECT_FALSE(has_padding<wire::Material>());
  EXPECT_FALSE(has_padding<wire::FilmSettings>());
  EXPECT_FALSE(has_padding<wire::AmbientLight>());
  EXPECT_FALSE(has_padding<wire::Fog>());
}

#endif

}  // namespace
}  // namespace mars::film
