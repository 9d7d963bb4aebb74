// What terminals are sent, read back as they read it.
#include "host/preview/terminal_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <regex>

#include "host/preview/key_press.h"

namespace mars::preview {
namespace {

images::Image colourful(std::uint32_t width, std::uint32_t height) {
  images::Image image{width, height, {}};
  for (std::uint32_t i = 0; i < width * height; ++i) image.pixels.push_back((i * 7919u) % 97 * 0x020304u & 0xffffffu);
  return image;
}

// The screen of a terminal that knows placing, 24-bit colours and upper halves.
struct Screen {
  std::map<std::pair<int, int>, std::array<std::uint32_t, 2>> cells;  // (row, column): upper, lower pixel
  int row = 1, column = 1;
  std::uint32_t fore = 0, back = 0;

  void take(const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
      if (text[at] == '\x1b') {
        std::size_t end = at + 2;
        while (text[end] < '@') ++end;
        handle_key(text.substr(at + 2, end - at - 2), text[end]);
        at = end + 1;
      } else if (text[at] == ' ') {
        cells[{row, column++}] = {back, back};
        ++at;
      } else {
        ASSERT_EQ(text.substr(at, 3), "\xe2\x96\x80");
        cells[{row, column++}] = {fore, back};
        at += 3;
      }
    }
  }

  void handle_key(const std::string& words, char what) {
    int a = 0, b = 0, red = 0, green = 0, blue = 0;
    if (what == 'H' && std::sscanf(words.c_str(), "%d;%d", &a, &b) == 2) row = a, column = b;
    if (what == 'm' && std::sscanf(words.c_str(), "%d;2;%d;%d;%d", &a, &red, &green, &blue) == 4)
      (a == 38 ? fore : back) = static_cast<std::uint32_t>(red | green << 8 | blue << 16);
  }

  std::uint32_t pixel(std::uint32_t x, std::uint32_t y) const { return cells.at({int(y / 2) + 1, int(x) + 1})[y % 2]; }
};

TEST(Blocks, ShowEveryPixel) {
  const auto blocks = make_blocks(true);
  Screen screen;
  for (const std::uint32_t height : {8u, 7u}) {
    const images::Image image = colourful(9, height);
    blocks->forget();
    screen.take(blocks->shown(image));
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < 9; ++x) EXPECT_EQ(screen.pixel(x, y), image.pixels[y * 9 + x]);
  }
}

TEST(Blocks, SendOnlyWhatChanged) {
  const auto blocks = make_blocks(true);
  images::Image image = colourful(40, 20);
  Screen screen;
  screen.take(blocks->shown(image));
  EXPECT_LT(blocks->shown(image).size(), 25u);  // nothing but begin and end
  image.pixels[5 * 40 + 33] = 0x123456;
  const std::string change = blocks->shown(image);
  EXPECT_LT(change.size(), 80u);
  screen.take(change);
  EXPECT_EQ(screen.pixel(33, 5), 0x123456u);
  EXPECT_EQ(screen.pixel(32, 5), image.pixels[5 * 40 + 32]);
}

TEST(Blocks, Of256ColoursTakeTheNearest) {
  const auto blocks = make_blocks(false);
  const auto shown = [&](std::uint32_t pixel) {
    blocks->forget();
    std::smatch found;
    const std::string text = blocks->shown({1, 2, {pixel, pixel}});
    return std::regex_search(text, found, std::regex("48;5;([0-9]+)m")) ? std::stoi(found[1]) : -1;
  };
  EXPECT_EQ(shown(0x000000), 16);
  EXPECT_EQ(shown(0xffffff), 231);
  EXPECT_EQ(shown(0x0000ff), 196);  // red
  EXPECT_EQ(shown(0x808080), 244);
  EXPECT_EQ(shown(0x131211), 233);
}

std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned value = 0;
  int bits = 0;
  for (const char digit : text.substr(0, text.find('='))) {
    value = value << 6 | static_cast<unsigned>(digits.find(digit));
    if ((bits += 6) >= 8) bytes += static_cast<char>(value >> (bits -= 8) & 0xff);
  }
  return bytes;
}

TEST(Kitty, SendsThePictureInPieces) {
  const auto kitty = make_kitty();
  for (const std::uint32_t width : {1u, 2u, 3u, 120u}) {
    const images::Image image = colourful(width, 90);
    const std::string text = kitty->shown(image);
    std::string whole;
    const std::regex piece("\x1b_G([^;]*)m=([01]);([^\x1b]*)\x1b");
    int pieces = 0, last = 0;
    for (std::sregex_iterator i(text.begin(), text.end(), piece), end; i != end; ++i, ++pieces) {
      EXPECT_LE((*i)[3].length(), 4096);
      last += (*i)[2] == "0";
      whole += (*i)[3];
    }
    EXPECT_EQ(last, 1);
    EXPECT_EQ(pieces > 1, width == 120u);
    const std::string bytes = from_base64(whole);
    EXPECT_EQ(images::decode_png(std::as_bytes(std::span(bytes)), "sent").pixels, image.pixels);
  }
}

// Sixel's picture, as colours of a palette in hundredths.
images::Image read_sixel(const std::string& text) {
  std::size_t at = text.find("\"1;1;") + 5;
  const auto number = [&] {
    std::uint32_t value = 0;
    while (text[at] >= '0' && text[at] <= '9') value = 10 * value + static_cast<std::uint32_t>(text[at++] - '0');
    return value;
  };
  images::Image image;
  image.width = number();
  ++at;
  image.height = number();
  image.pixels.assign(std::size_t{image.width} * image.height, 0xffffffffu);
  std::array<std::uint32_t, 256> palette{};
  std::uint32_t color = 0, x = 0, top = 0;
  while (text[at] != '\x1b') {
    const char what = text[at];
    if (what == '#') {
      ++at;
      color = number();
      if (text[at] != ';') continue;
      at += 3;  // ";2;"
      for (int shift = 0; shift < 24; shift += 8) {
        palette[color] |= number() * 255 / 100 << shift;
        if (shift < 16) ++at;
      }
    } else if (what == '$' || what == '-') {
      x = 0;
      top += what == '-' ? 6 : 0;
      ++at;
    } else {
      std::uint32_t count = 1;
      if (what == '!') {
        ++at;
        count = number();
      }
      const int bits = text[at++] - 63;
      for (; count > 0; --count, ++x)
        for (std::uint32_t row = 0; row < 6; ++row)
          if (bits >> row & 1) image.pixels.at(std::size_t{top + row} * image.width + x) = palette[color];
    }
  }
  return image;
}

TEST(Sixel, ShowsEveryPixelInNearlyItsColour) {
  const images::Image image = colourful(50, 20);
  const images::Image read = read_sixel(make_sixel()->shown(image));
  ASSERT_EQ(read.width, 50u);
  ASSERT_EQ(read.height, 20u);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (int shift = 0; shift < 24; shift += 8)  // five bits a channel
      EXPECT_NEAR(double(read.pixels[i] >> shift & 0xff), double(image.pixels[i] >> shift & 0xff), 9);
}

TEST(Sixel, TakesTheNearestWhereThereAreTooManyColours) {
  images::Image image{64, 64, {}};
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) image.pixels.push_back(4 * x | 4 * y << 8 | (2 * (x + y)) << 16);
  const images::Image read = read_sixel(make_sixel()->shown(image));
  double error = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (int shift = 0; shift < 24; shift += 8)
      error += std::abs(double(read.pixels[i] >> shift & 0xff) - double(image.pixels[i] >> shift & 0xff));
  EXPECT_LT(error / (3 * 64 * 64), 40);
}

TEST(KeyPress, ReadsCharactersAndSequences) {
  std::string bytes = "q\x1b[A\x1bOB \x1b[3~x\x1b[1;5C";
  const std::vector<KeyPress> keys = take_keys(bytes);
  EXPECT_EQ(bytes, "");
  const std::vector<KeyPress> should{
      {'q', Special::none}, {0, Special::up}, {0, Special::down}, {' ', Special::none}, {'x', Special::none}};
  EXPECT_EQ(keys, should);
}

TEST(KeyPress, EscapeIsAKeyWhereNoSequenceFollows) {
  std::string bytes = "\x1b\x1b\x1b[Z\t\x1b";
  EXPECT_EQ(take_keys(bytes),
            (std::vector<KeyPress>{
                {0, Special::escape}, {0, Special::escape}, {0, Special::back_tab}, {'\t', Special::none}}));
  EXPECT_EQ(bytes, kEscape);  // time tells
}

TEST(KeyPress, WaitsForTheRestOfASequence) {
  std::string bytes = "a\x1b[";
  EXPECT_EQ(take_keys(bytes).size(), 1u);
  EXPECT_EQ(bytes, "\x1b[");
  bytes += "D";
  EXPECT_EQ(take_keys(bytes), (std::vector<KeyPress>{{0, Special::left}}));
}

}  // namespace
}  // namespace mars::preview
