// A strip has at most kMaxStripBytes, whatever its lines show.
#include "node/raster/strip_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "node/wire/film_parts.h"

namespace mars::raster {
namespace {

using wire::PixelFormat;

// Shows a line in runs of `length` pixels with one between them.
void draw_line(std::uint32_t line, std::uint32_t width, std::uint32_t length, PixelFormat format,
               StripBuffer::Layer& layer) {
  shading::Shaded shaded{0, 0};
  for (std::uint32_t first = 0; first < width; first += length + 1) {
    const std::uint32_t count = std::min(length, width - first);
    layer.next_run()[shaded.runs++] = {line, static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(count)};
    shaded.pixels += count;
  }
  std::fill_n(layer.next_pixel(), shaded.pixels * wire::pixel_bytes(format), std::byte{1});
  layer.added(shaded);
}

struct Full {
  std::uint32_t lines = 0;
  std::size_t bytes = 0;
};

struct Slot {
  alignas(64) std::byte bytes[wire::kSlotBytes];
};

Full fill(std::uint32_t width, std::uint32_t length, PixelFormat format) {
  const auto slot = std::make_unique_for_overwrite<Slot>();
  StripBuffer buffer(format);
  buffer.begin(slot->bytes, width, true);
  Full full;
  while (const std::uint32_t lines = buffer.lines_that_fit()) {
    for (std::uint32_t i = 0; i < lines; ++i, ++full.lines)
      for (auto* layer : {&buffer.constant(), &buffer.moving()}) draw_line(full.lines, width, length, format, *layer);
  }
  wire::Strip header{};
  const auto strip = buffer.finish(header);
  EXPECT_EQ(strip.data(), slot->bytes);
  full.bytes = strip.size();
  EXPECT_EQ(full.bytes, sizeof header + header.pixels * wire::pixel_bytes(format) +
                            (header.constant_runs + header.moving_runs) * sizeof(wire::Run));
  EXPECT_EQ(header.work.bytes_to_host, full.bytes);
  return full;
}

TEST(StripBuffer, NeverHasMoreThanItMay) {
  for (const std::uint32_t width : {1u, 2u, 3u, 640u, 1921u, wire::kMaxSide})
    for (const std::uint32_t length : {1u, 2u, 5u, width})
      for (const PixelFormat format : {PixelFormat::rgb8, PixelFormat::half}) {
        const Full full = fill(width, length, format);
        EXPECT_LE(full.bytes, wire::kMaxStripBytes) << width << " pixels in runs of " << length;
        EXPECT_GE(full.lines, 1u);
      }
}

TEST(StripBuffer, IsUsedWell) {
  constexpr std::size_t kFull = std::size_t{512} << 10;
  for (const PixelFormat format : {PixelFormat::rgb8, PixelFormat::rgb16}) {
    EXPECT_GE(fill(1920, 1920, format).bytes, kFull);
    EXPECT_GE(fill(wire::kMaxSide, 1, format).bytes, kFull);
  }
}

TEST(StripBuffer, BeginsEmpty) {
  const auto slot = std::make_unique_for_overwrite<Slot>(), other = std::make_unique_for_overwrite<Slot>();
  StripBuffer buffer(PixelFormat::rgb8);
  buffer.begin(slot->bytes, 64, true);
  const std::uint32_t lines = buffer.lines_that_fit();
  EXPECT_GT(lines, 0u);
  draw_line(0, 64, 64, PixelFormat::rgb8, buffer.moving());
  buffer.begin(other->bytes, 64, false);
  EXPECT_TRUE(buffer.moving().runs().empty());
  EXPECT_EQ(buffer.lines_that_fit(), lines);
}

}  // namespace
}  // namespace mars::raster
