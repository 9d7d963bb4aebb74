#include "host/images/picture_bands.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <random>

#include "host/images/encode_bands.h"
#include "host/images/exr_file.h"
#include "host/images/picture_file.h"
#include "host/images/png_file.h"

namespace mars::images {
namespace {

constexpr PictureFormat kFormats[] = {PictureFormat::png,       PictureFormat::png16,       PictureFormat::exr,
                                      PictureFormat::png_alpha, PictureFormat::png16_alpha, PictureFormat::exr_alpha};

using Words = std::vector<std::uint32_t>;

Image decoded(PictureFormat format, std::span<const std::byte> file) {
  switch (format) {
    case PictureFormat::png16: return decode_png16(file, "x");
    case PictureFormat::exr: return decode_exr(file, "x");
    case PictureFormat::png_alpha: return decode_png_with_alpha(file, "x");
    case PictureFormat::png16_alpha: return decode_png16_with_alpha(file, "x");
    case PictureFormat::exr_alpha: return decode_exr(file, "x", wire::PixelFormat::half_alpha);
    default: return decode_png(file, "x");
  }
}

// Like a frame: runs of one colour, of grey, repeats of the line above, noise.
Words picture(std::mt19937& random, const PictureBands& bands) {
  const std::size_t line = bands.words_of({0, 1}), words = line / bands.width();
  Words pixels(bands.words_of({0, bands.height()}));
  for (std::size_t at = 0; at < pixels.size();) {
    const std::size_t count = std::min<std::size_t>(pixels.size() / words - at / words, 1 + random() % 300);
    const std::uint32_t way = random() % 4, grey = (random() & 0xff) * 0x010101;
    for (std::size_t k = 0; k < count * words; ++k, ++at) {
      const std::uint32_t noise = random();
      const std::uint32_t value = way == 0 ? grey : way == 1 && at >= line ? pixels[at - line] : way == 2 ? noise : 0;
      const bool alpha = has_alpha(bands.format());
      if (words == 1)
        pixels[at] = alpha ? value : value & 0xffffff;
      else
        pixels[at] = alpha || at % 2 == 0 ? value & 0x7bff7bff : value & 0x7bff;
    }
  }
  return pixels;
}

TEST(PictureBands, CutEveryLineOnce) {
  for (const PictureFormat format : kFormats) {
    for (const auto& [width, height] :
         {std::pair{1u, 1u}, {1920u, 1080u}, {7680u, 4320u}, {16384u, 3u}, {7u, 16384u}}) {
      const PictureBands bands(format, width, height);
      std::uint32_t line = 0;
      for (std::size_t band = 0; band < bands.count(); ++band) {
        EXPECT_EQ(bands.lines_of(band).first, line);
        EXPECT_GT(bands.lines_of(band).end, line);
        line = bands.lines_of(band).end;
      }
      EXPECT_EQ(line, height);
    }
  }
}

TEST(PictureBands, GiveBackEveryPixel) {
  std::mt19937 random(11);
  for (const PictureFormat format : kFormats) {
    for (const auto& [width, height] :
         {std::pair{1u, 1u}, {2u, 3u}, {86u, 2u}, {87u, 9u}, {259u, 40u}, {641u, 360u}, {1920u, 90u}, {16384u, 17u}}) {
      const PictureBands bands(format, width, height);
      for (int k = 0; k < 3; ++k) {
        const Words pixels = picture(random, bands);
        const std::vector<std::byte> file = encode_picture(format, width, height, pixels, "a note");
        ASSERT_EQ(decoded(format, file).pixels, pixels) << width << "x" << height;
      }
    }
  }
}

TEST(PictureBands, DependOnTheirOwnPixelsAlone) {
  std::mt19937 random(12);
  for (const PictureFormat format : kFormats) {
    const PictureBands bands(format, 640, 360);
    ASSERT_GT(bands.count(), 3u);
    const Words one = picture(random, bands);
    Words other = picture(random, bands);
    const Lines lines = bands.lines_of(2);
    const std::size_t first = bands.words_of({0, lines.first}), count = bands.words_of(lines);
    std::copy_n(&one[first], count, &other[first]);
    const auto file = [&](const Words& pixels) { return encode_picture(format, 640, 360, pixels); };
    const EncodedBand band = encode_band(bands, 2, std::span(one).subspan(first, count));
    for (const Words& pixels : {one, other}) {
      const std::vector<std::byte> bytes = file(pixels);
      EXPECT_FALSE(std::ranges::search(bytes, band.bytes).empty());
    }
    EXPECT_NE(file(one), file(other));
  }
}

}  // namespace
}  // namespace mars::images
