#include "host/images/png_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string_view>

#include "host/content/document/whole_file.h"
#include "host/images/picture_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::images {
namespace {

std::vector<std::uint32_t> random_pixels(std::size_t count) {
  std::mt19937 random(7);
  std::vector<std::uint32_t> pixels(count);
  for (std::uint32_t& pixel : pixels) pixel = random() & 0xffffff;
  return pixels;
}

std::vector<std::uint32_t> random_wide_pixels(std::size_t count) {
  std::mt19937 random(8);
  std::vector<std::uint32_t> pixels(2 * count);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = random() & (i % 2 == 0 ? 0xffffffff : 0xffff);
  return pixels;
}

TEST(PngFile, GivesBackWhatWasWritten) {
  const test::TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 200u}, {640u, 5u}, {16384u, 1u}}) {
    const std::vector<std::uint32_t> pixels = random_pixels(std::size_t{width} * height);
    document::write_whole_file(folder / "x.png", encode_picture(PictureFormat::png, width, height, pixels));
    const Image image = read_picture(PictureFormat::png, folder / "x.png");
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(image.pixels, pixels);
  }
}

// Words of two pixels' channels are odd ones, so that no byte is taken for another.
TEST(PngFile, GivesBackSixteenBits) {
  const test::TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 200u}, {16384u, 1u}}) {
    const std::vector<std::uint32_t> pixels = random_wide_pixels(std::size_t{width} * height);
    document::write_whole_file(folder / "x.png", encode_picture(PictureFormat::png16, width, height, pixels));
    const Image image = read_picture(PictureFormat::png16, folder / "x.png");
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(image.pixels, pixels);
    const Image narrow = read_picture(PictureFormat::png, folder / "x.png");
    ASSERT_EQ(narrow.pixels.size(), pixels.size() / 2);
    EXPECT_NEAR(narrow.pixels[0] & 255, (pixels[0] & 65535) / 257.0, 0.51);
  }
}

TEST(PngFile, CarriesANoteBesideThePixels) {
  const test::TemporaryFolder folder;
  const std::string note = R"({"frame": 7})";
  for (const PictureFormat format : {PictureFormat::png, PictureFormat::png16, PictureFormat::exr}) {
    const std::vector<std::uint32_t> pixels(6 * 4 * (format == PictureFormat::png ? 1 : 2), 0x1234);
    const std::vector<std::byte> bytes = encode_picture(format, 6, 4, pixels, note);
    document::write_whole_file(folder / "x", bytes);
    EXPECT_EQ(read_note(folder / "x"), note);
    EXPECT_EQ(read_picture(format, folder / "x").pixels, pixels);
    for (std::size_t size = 0; size < bytes.size(); size += 7) {
      document::write_whole_file(folder / "x", std::span(bytes).first(size));
      EXPECT_EQ(read_note(folder / "x").value_or(note), note) << "a part of it passes for the whole";
    }
    document::write_whole_file(folder / "x", encode_picture(format, 6, 4, pixels));
    EXPECT_EQ(read_note(folder / "x"), std::nullopt);
  }
}

TEST(PngFile, ADamagedNoteIsNone) {
  std::vector<std::byte> bytes = encode_picture(PictureFormat::png, 2, 1, random_pixels(2), "a note");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  bytes[text.find("a note")] ^= std::byte{1};
  EXPECT_EQ(note_in_png(bytes), std::nullopt);
}

TEST(PngFile, IsEightBitRgbMarkedSrgb) {
  const std::vector<std::byte> bytes = encode_picture(PictureFormat::png, 2, 1, random_pixels(2));
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_EQ(text.substr(12, 4), "IHDR");
  EXPECT_EQ(text[24], 8);  // bits
  EXPECT_EQ(text[25], 2);  // RGB
  EXPECT_TRUE(document::holds(text, "sRGB"));
}

TEST(PngFile, EveryCutOfAFileIsTold) {
  const std::vector<std::byte> bytes = encode_picture(PictureFormat::png, 20, 20, random_pixels(400));
  // All but the closing chunk's own check number, which libpng does not ask for.
  for (std::size_t size = 0; size + 4 < bytes.size(); size += 7) {
    const std::string failure = document::failure_of([&] { decode_png(std::span(bytes).first(size), "cut.png"); });
    EXPECT_TRUE(document::holds(failure, "cut.png: not a whole PNG picture")) << size << " bytes of " << bytes.size();
  }
}

TEST(PngFile, WhatIsWrongIsToldInWordsOfOurs) {
  const std::vector<std::byte> bytes = encode_picture(PictureFormat::png, 20, 20, random_pixels(400));
  const auto failure_at = [&](std::size_t place, std::string_view now) {
    std::vector<std::byte> damaged = bytes;
    std::ranges::copy(std::as_bytes(std::span(now)), damaged.begin() + static_cast<std::ptrdiff_t>(place));
    return document::failure_of([&] { decode_png(damaged, "a.png"); });
  };
  EXPECT_TRUE(document::holds(failure_at(0, "GIF89a"), "a.png: not a whole PNG picture: it does not begin as one"));
  EXPECT_TRUE(document::holds(failure_at(29, "xxxx"), "its bytes have changed since it was written"));
  const std::string_view no_size("\0\0\0\0\0\0\0\0\x08\x02\0\0\0\xb4\xe9\xeb\x45", 17);
  for (const std::string& failure : {failure_at(16, no_size), failure_at(0, "GIF89a"), failure_at(29, "xxxx")})
    for (const char* word : {"IHDR", "CRC", "Invalid", "zlib"}) EXPECT_FALSE(document::holds(failure, word)) << failure;
  const std::string cut = document::failure_of([&] { decode_png(std::span(bytes).first(300), "a.png"); });
  EXPECT_TRUE(document::holds(cut, "it ends too early")) << cut;
}

TEST(PngFile, NoDamageDoesHarm) {
  const std::vector<std::byte> bytes = encode_picture(PictureFormat::png, 20, 20, random_pixels(400));
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    std::vector<std::byte> damaged = bytes;
    for (int j = 0; j < 3; ++j) damaged[random() % damaged.size()] = static_cast<std::byte>(random());
    document::failure_of([&] { decode_png(damaged, "damaged.png"); });
  }
}

TEST(PngFile, OtherFilesAreTold) {
  const test::TemporaryFolder folder;
  document::write_whole_file(folder / "x.png", std::string_view("no picture at all"));
  EXPECT_TRUE(document::holds(document::failure_of([&] { read_picture(PictureFormat::png, folder / "x.png"); }),
                              "not a whole PNG picture"));
}

}  // namespace
}  // namespace mars::images
