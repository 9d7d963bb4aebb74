#include "host/images/exr_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "host/content/document/whole_file.h"
#include "host/images/picture_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::images {
namespace {

// Finite half floats, not negative.
std::vector<std::uint32_t> random_halves(std::size_t count) {
  std::mt19937 random(7);
  const auto half = [&] { return random() % 0x7c00; };
  std::vector<std::uint32_t> pixels;
  for (std::size_t i = 0; i < count; ++i) {
    pixels.push_back(half() | half() << 16);
    pixels.push_back(half());
  }
  return pixels;
}

TEST(ExrFile, GivesBackWhatWasWritten) {
  const test::TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 200u}, {640u, 5u}, {16384u, 1u}, {1u, 16384u}}) {
    const std::vector<std::uint32_t> pixels = random_halves(std::size_t{width} * height);
    document::write_whole_file(folder / "x.exr", encode_picture(PictureFormat::exr, width, height, pixels));
    const Image image = read_picture(PictureFormat::exr, folder / "x.exr");
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(image.pixels, pixels);
  }
}

TEST(ExrFile, EveryCompressionGivesBackEveryHalf) {
  const std::vector<std::uint32_t> pixels = random_halves(97 * 83);
  for (const char* name : {"zip", "zips", "piz", "pxr24", "rle", "none"}) {
    const PictureBands bands(PictureFormat::exr, 97, 83, compression_of(name).value());
    const Image image = decode_exr(encode_picture(bands, pixels, {}), name);
    EXPECT_EQ(image.pixels, pixels) << name;
    EXPECT_STREQ(name_of(bands.compression()), name);
  }
  EXPECT_EQ(compression_of("dwaa"), std::nullopt) << "it changes pixels";
  EXPECT_EQ(PictureBands(PictureFormat::exr, 3000, 100, Compression::piz).lines_a_band(), 32u)
      << "piz has chunks of 32";
}

TEST(ExrFile, SaysWhichFrameItIs) {
  const std::vector<std::uint32_t> pixels = random_halves(2);
  const PictureBands bands(PictureFormat::exr, 2, 1);
  const auto text = [&](const FileFacts& facts) {
    const std::vector<std::byte> bytes = encode_picture(bands, pixels, facts);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  EXPECT_FALSE(document::holds(text({}), "framesPerSecond"));
  const std::string of_24 = text({.note = "a note", .rate = 24, .frame = 49});
  EXPECT_TRUE(document::holds(of_24, std::string("framesPerSecond\0rational\0\10\0\0\0\30\0\0\0\1", 34)));
  EXPECT_TRUE(document::holds(of_24, std::string("imageCounter\0int\0\4\0\0\0\61", 22)));
  EXPECT_TRUE(document::holds(of_24, std::string("timeCode\0timecode\0\10\0\0\0\1\2\0\0", 26))) << "0:00:02:01";
  EXPECT_FALSE(document::holds(text({.rate = 60, .frame = 49}), "timeCode")) << "it counts to 30";
  EXPECT_TRUE(document::holds(text({.rate = 23.976, .frame = 49}), std::string("\300\135\0\0\351\3\0\0", 8)))
      << "24000/1001";
}

TEST(ExrFile, NamesItsColours) {
  const std::vector<std::byte> bytes = encode_picture(PictureFormat::exr, 2, 1, random_halves(2));
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_EQ(text.substr(0, 4), "v/1\x01");
  EXPECT_TRUE(document::holds(text, "chromaticities"));
}

TEST(ExrFile, EveryCutOfAFileIsTold) {
  const std::vector<std::byte> bytes = encode_picture(PictureFormat::exr, 20, 40, random_halves(800));
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    const std::string failure = document::failure_of([&] { decode_exr(std::span(bytes).first(size), "cut.exr"); });
    EXPECT_TRUE(document::holds(failure, "cut.exr: not a whole EXR picture")) << size << " bytes of " << bytes.size();
    EXPECT_TRUE(document::holds(failure, "it ends within its header") ||
                document::holds(failure, "its bytes are cut short or damaged"))
        << failure << " in words of OpenEXR";
  }
}

TEST(ExrFile, NoDamageDoesHarm) {
  const std::vector<std::byte> bytes = encode_picture(PictureFormat::exr, 20, 20, random_halves(400));
  std::mt19937 random(3);
  for (int i = 0; i < 600; ++i) {
    std::vector<std::byte> damaged = bytes;
    const std::size_t end = i % 2 == 0 ? damaged.size() : 200;  // much of what a message repeats is in the header
    for (int j = 0; j < 3; ++j) damaged[random() % end] = static_cast<std::byte>(random());
    const std::string failure = document::failure_of([&] { decode_exr(damaged, "damaged.exr"); });
    EXPECT_TRUE(std::ranges::all_of(failure, [](char c) { return c >= ' ' && c <= '~'; })) << failure;
  }
}

TEST(ExrFile, OtherFilesAreTold) {
  const test::TemporaryFolder folder;
  document::write_whole_file(folder / "x.exr", std::string_view("no picture at all"));
  const std::string failure = document::failure_of([&] { read_picture(PictureFormat::exr, folder / "x.exr"); });
  EXPECT_TRUE(document::holds(failure, "not a whole EXR picture")) << failure;
}

}  // namespace
}  // namespace mars::images
