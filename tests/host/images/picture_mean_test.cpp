// The mean of a picture is a mean of light, in which pixels that are not seen do not count.
#include "host/images/picture_mean.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <vector>

#include "host/images/picture_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/images/rgba_png.h"

namespace mars::images {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

TEST(PictureMean, IsOfLightNotOfLevels) {
  const std::vector<std::byte> png =
      encode_picture(PictureFormat::png, 2, 1, std::vector<std::uint32_t>{0x000000, 0x00ffff});
  const PictureMean mean = picture_mean(png, "half.png").value();
  EXPECT_NEAR(mean.light[0], 0.5, 1e-12) << "black and white paper send half of white's light, not a level of 128";
  EXPECT_NEAR(mean.light[1], 0.5, 1e-12);
  EXPECT_EQ(mean.light[2], 0);
  EXPECT_NEAR(mean.values[0], 0.5, 1e-12);
  const PictureMean grey =
      picture_mean(encode_picture(PictureFormat::png, 1, 1, std::vector<std::uint32_t>{0x808080}), "grey.png").value();
  EXPECT_NEAR(grey.light[0], 0.21586, 1e-5) << "sRGB's 128";
}

TEST(PictureMean, CountsPixelsByTheirAlpha) {
  const PictureMean mean =
      picture_mean(bytes_of(test::rgba_png(3, 1, {0xff0000ff, 0x00ff0000, 0x5500ff00})), "leaf.png").value();
  EXPECT_NEAR(mean.light[0], 0.75, 1e-12) << "red, opaque";
  EXPECT_NEAR(mean.light[1], 0.25, 1e-12) << "green, a third";
  EXPECT_NEAR(mean.light[2], 0, 1e-12) << "blue, not seen";
  EXPECT_NEAR(mean.values[2], 1.0 / 3, 1e-12) << "as numbers, all count";
  const PictureMean hidden = picture_mean(bytes_of(test::rgba_png(2, 1, {0x0000ff, 0x00ff00})), "no.png").value();
  EXPECT_NEAR(hidden.light[0], 0.5, 1e-12) << "nothing is seen: all count";
}

TEST(PictureMean, IsOfJpegToo) {
  std::vector<unsigned char> pixels(16 * 16 * 3, 200);
  unsigned char* made = nullptr;
  unsigned long size = 0;
  const tjhandle encoder = tjInitCompress();
  ASSERT_EQ(tjCompress2(encoder, pixels.data(), 16, 0, 16, TJPF_RGB, &made, &size, TJSAMP_444, 95, 0), 0);
  const std::string jpeg(reinterpret_cast<const char*>(made), size);
  tjFree(made);
  tjDestroy(encoder);
  EXPECT_NEAR(picture_mean(bytes_of(jpeg), "a.jpg").value().values[0], 200 / 255.0, 0.005);
  EXPECT_TRUE(document::holds(document::failure_of([&] { picture_mean(bytes_of(jpeg.substr(0, 30)), "a.jpg"); }),
                              "a.jpg: not a whole JPEG picture: "));
}

TEST(PictureMean, OfOtherFilesThereIsNone) {
  EXPECT_FALSE(picture_mean(bytes_of("RIFF....WEBP"), "a.webp"));
  EXPECT_FALSE(picture_mean({}, "empty"));
}

}  // namespace
}  // namespace mars::images
