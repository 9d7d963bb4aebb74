#include "host/preview/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "hal/failure/failure.h"
#include "node/wire/film_parts.h"

namespace mars::preview {
namespace {

// Rows of three pixels from the top, the leftmost in the highest bit.
constexpr std::array<std::array<std::uint8_t, 5>, 10> kDigits{{{7, 5, 5, 5, 7},
                                                               {2, 6, 2, 2, 7},
                                                               {7, 1, 7, 4, 7},
                                                               {7, 1, 7, 1, 7},
                                                               {5, 5, 7, 1, 1},
                                                               {7, 4, 7, 1, 7},
                                                               {7, 4, 7, 5, 7},
                                                               {7, 1, 1, 1, 1},
                                                               {7, 5, 7, 5, 7},
                                                               {7, 5, 7, 1, 7}}};
constexpr std::uint32_t kDot = 2;     // pixels a side, of a digit's pixel
constexpr std::uint32_t kGap = 6;     // between pictures
constexpr std::uint32_t kLabel = 18;  // high, beneath each picture
constexpr std::uint32_t kPaperPixel = 0x1a1512, kInk = 0xa8a098;

void write_number(images::Image& sheet, std::uint32_t number, std::uint32_t x, std::uint32_t y) {
  for (const char digit : std::to_string(number)) {
    const auto& rows = kDigits[static_cast<std::size_t>(digit - '0')];
    for (std::uint32_t dy = 0; dy < 5 * kDot; ++dy)
      for (std::uint32_t dx = 0; dx < 3 * kDot; ++dx)
        if (rows[dy / kDot] >> (2 - dx / kDot) & 1 && x + dx < sheet.width)
          sheet.pixels[std::size_t{y + dy} * sheet.width + x + dx] = kInk;
    x += 4 * kDot;
  }
}

}  // namespace

images::Image contact_sheet(const std::vector<SheetPicture>& pictures, std::uint32_t columns) {
  check(!pictures.empty(), "a sheet has pictures");
  const images::Image& first = *pictures.front().image;
  const std::uint64_t count = pictures.size();
  if (columns == 0)
    columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(double(count) * first.height / first.width)));
  columns = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(columns, 1, count));
  const std::uint64_t rows = (count + columns - 1) / columns;
  const std::uint64_t width = kGap + std::uint64_t{columns} * (first.width + kGap);
  const std::uint64_t height = kGap + rows * (first.height + kLabel);
  if (width > wire::kMaxSide || height > wire::kMaxSide)
    throw Failure("would have " + std::to_string(width) + "x" + std::to_string(height) + " pixels", "contact sheet",
                  "ask for fewer frames with --every or --frames, or smaller ones with --size");
  images::Image sheet{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
  sheet.pixels.assign(width * height, kPaperPixel);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t x = kGap + i % columns * (first.width + kGap), y = kGap + i / columns * (first.height + kLabel);
    for (std::uint32_t line = 0; line < first.height; ++line)
      std::copy_n(&pictures[i].image->pixels[std::size_t{line} * first.width], first.width,
                  &sheet.pixels[std::size_t{y + line} * width + x]);
    write_number(sheet, pictures[i].frame, x, y + first.height + (kLabel - 5 * kDot) / 2);
  }
  return sheet;
}

}  // namespace mars::preview
