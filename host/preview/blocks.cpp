#include <array>
#include <charconv>

#include "host/preview/terminal_picture.h"

namespace mars::preview {
namespace {

constexpr std::string_view kUpperHalf = "\xe2\x96\x80";
constexpr std::uint32_t kNone = 0xffffffff;

// The nearest of the 6 x 6 x 6 colours from 16 on and the 24 greys from 232 on.
std::uint32_t index_of(std::uint32_t pixel) {
  const std::array<int, 3> rgb{static_cast<int>(pixel & 0xff), static_cast<int>(pixel >> 8 & 0xff),
                               static_cast<int>(pixel >> 16 & 0xff)};
  const auto level = [](int value) { return value < 48 ? 0 : value < 115 ? 1 : (value - 35) / 40; };
  const auto value_of = [](int level) { return level == 0 ? 0 : 55 + 40 * level; };
  int cube = 0, cube_error = 0, grey_error = 0;
  const int grey = std::min(std::max((rgb[0] + rgb[1] + rgb[2]) / 3 - 3, 0) / 10, 23);
  for (const int value : rgb) {
    cube = cube * 6 + level(value);
    cube_error += (value - value_of(level(value))) * (value - value_of(level(value)));
    grey_error += (value - 8 - 10 * grey) * (value - 8 - 10 * grey);
  }
  return static_cast<std::uint32_t>(grey_error < cube_error ? 232 + grey : 16 + cube);
}

class Blocks : public TerminalPicture {
 public:
  explicit Blocks(bool colors24) : colors24_(colors24) {
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      char* const text = numbers_[i].data();
      numbers_[i][4] = static_cast<char>(std::to_chars(text + 1, text + 4, i).ptr - text);
      text[0] = ';';
    }
  }

  images::PictureSize space(const Terminal& terminal, std::uint32_t lines) const override {
    const images::PictureSize cells = terminal.cells();
    return {cells.width, 2 * (cells.height > lines ? cells.height - lines : 1)};
  }

  const std::string& shown(const images::Image& image) override {
    text_ = "\x1b[?2026h";
    upper_ = lower_ = kNone;
    const std::uint32_t rows = (image.height + 1) / 2;
    cells_.resize(std::size_t{rows} * image.width, {kNone, kNone});
    for (std::uint32_t row = 0; row < rows; ++row) show_row(image, row);
    text_ += "\x1b[0m\x1b[?2026l";
    return text_;
  }

  void forget() override { cells_.clear(); }

 private:
  struct Cell {
    std::uint32_t upper, lower;  // pixels, or numbers of colours
  };

  void show_row(const images::Image& image, std::uint32_t row) {
    const std::uint32_t* upper = &image.pixels[std::size_t{2} * row * image.width];
    const std::uint32_t* lower = 2 * row + 1 < image.height ? upper + image.width : nullptr;
    Cell* cells = &cells_[std::size_t{row} * image.width];
    std::uint32_t cursor = kNone;  // the column it stands at
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const Cell cell{color(upper[x]), lower == nullptr ? color(0) : color(lower[x])};
      if (cell.upper == cells[x].upper && cell.lower == cells[x].lower) continue;
      if (cursor != x) {
        text_ += "\x1b[";
        add_number(row + 1);
        text_ += ';';
        add_number(x + 1);
        text_ += 'H';
      }
      cursor = x + 1;
      cells[x] = cell;
      if (cell.lower != lower_) set(48, lower_ = cell.lower);
      if (cell.upper == cell.lower) {
        text_ += ' ';
        continue;
      }
      if (cell.upper != upper_) set(38, upper_ = cell.upper);
      text_ += kUpperHalf;
    }
  }

  std::uint32_t color(std::uint32_t pixel) {
    if (colors24_) return pixel;
    if (pixel != last_pixel_) last_index_ = index_of(last_pixel_ = pixel);
    return last_index_;
  }

  // `what`: 38 the character's colour, 48 its background's.
  void set(int what, std::uint32_t color) {
    text_ += what == 38 ? "\x1b[38;" : "\x1b[48;";
    text_ += colors24_ ? '2' : '5';
    for (int shift = 0; shift < (colors24_ ? 24 : 8); shift += 8) {
      const auto& number = numbers_[color >> shift & 0xff];
      text_.append(number.data(), static_cast<std::size_t>(number[4]));
    }
    text_ += 'm';
  }

  void add_number(std::uint32_t number) {
    std::array<char, 10> digits;
    text_.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
  }

  const bool colors24_;
  std::array<std::array<char, 5>, 256> numbers_{};  // ";0" ... ";255", and how long it is
  std::string text_;
  std::vector<Cell> cells_;                      // as they stand on the screen
  std::uint32_t upper_ = kNone, lower_ = kNone;  // colours as they are set
  std::uint32_t last_pixel_ = kNone, last_index_ = 0;
};

}  // namespace

std::unique_ptr<TerminalPicture> make_blocks(bool colors24) { return std::make_unique<Blocks>(colors24); }

std::unique_ptr<TerminalPicture> make_terminal_picture(Graphics graphics) {
  if (graphics == Graphics::kitty) return make_kitty();
  if (graphics == Graphics::sixel) return make_sixel();
  return make_blocks(graphics == Graphics::blocks);
}

}  // namespace mars::preview
