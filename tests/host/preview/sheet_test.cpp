// Contact sheets, scaled pictures, and which frames are written.
#include "host/preview/sheet.h"

#include <gtest/gtest.h>

#include "hal/failure/failure.h"
#include "host/preview/write_pictures.h"

namespace mars::preview {
namespace {

std::vector<SheetPicture> plain(std::uint32_t count, images::PictureSize size) {
  std::vector<SheetPicture> pictures;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::vector<std::uint32_t> pixels(std::size_t{size.width} * size.height, 0x100 * (i + 1));
    pictures.push_back({i, std::make_shared<const images::Image>(images::Image{size.width, size.height, pixels})});
  }
  return pictures;
}

TEST(Sheet, PutsPicturesInRows) {
  const images::Image sheet = contact_sheet(plain(5, {30, 20}), 3);
  EXPECT_EQ(sheet.width, 6u + 3 * 36);
  EXPECT_EQ(sheet.height, 6u + 2 * 38);
  for (std::uint32_t i = 0; i < 5; ++i) {
    const std::size_t x = 6 + i % 3 * 36, y = 6 + i / 3 * 38;
    EXPECT_EQ(sheet.pixels[y * sheet.width + x], 0x100 * (i + 1));
    EXPECT_EQ(sheet.pixels[(y + 19) * sheet.width + x + 29], 0x100 * (i + 1));
  }
}

TEST(Sheet, ATooLargeOneIsRefused) { EXPECT_THROW(contact_sheet(plain(400, {100, 100}), 200), Failure); }

TEST(Scaled, TakesTheMeanOrTheNearest) {
  const images::Image image{4, 2, {0, 8, 16, 24, 8, 16, 24, 32}};
  EXPECT_EQ(scaled(image, {2, 1}).pixels, (std::vector<std::uint32_t>{8, 24}));
  EXPECT_EQ(scaled(image, {8, 2}).pixels,
            (std::vector<std::uint32_t>{0, 0, 8, 8, 16, 16, 24, 24, 8, 8, 16, 16, 24, 24, 32, 32}));
  EXPECT_EQ(scaled(image, {4, 2}).pixels, image.pixels);
}

TEST(Fitted, KeepsTheShape) {
  EXPECT_EQ(fitted({1920, 1080}, {960, 960}), (images::PictureSize{960, 540}));
  EXPECT_EQ(fitted({1080, 1920}, {960, 960}), (images::PictureSize{540, 960}));
  EXPECT_EQ(fitted({16384, 1}, {80, 48}), (images::PictureSize{80, 1}));
}

TEST(FramesToWrite, AreThoseAskedFor) {
  using Frames = std::vector<std::uint32_t>;
  EXPECT_EQ(frames_to_write({"a.gif", std::nullopt, 1, 0, {}}, 4), (Frames{0, 1, 2, 3}));
  EXPECT_EQ(frames_to_write({"a.gif", std::nullopt, 3, 0, {}}, 8), (Frames{0, 3, 6}));
  EXPECT_EQ(frames_to_write({"a.png", film::FrameSet("2,5-"), 1, 0, {}}, 8), (Frames{2, 5, 6, 7}));
  EXPECT_EQ(frames_to_write({"a.png", std::nullopt, 1, 0, {}}, 100),
            (Frames{0, 9, 18, 27, 36, 45, 54, 63, 72, 81, 90, 99}));
  EXPECT_THROW(frames_to_write({"a.png", film::FrameSet("9"), 1, 0, {}}, 8), Failure);
}

}  // namespace
}  // namespace mars::preview
