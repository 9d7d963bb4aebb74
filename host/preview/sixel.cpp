#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include "host/preview/terminal_picture.h"

namespace mars::preview {
namespace {

constexpr std::size_t kColors = 255;
constexpr std::size_t kBuckets = 1 << 15;  // colours of five bits a channel

std::size_t bucket_of(std::uint32_t pixel) {
  return (pixel >> 3 & 31) | (pixel >> 11 & 31) << 5 | (pixel >> 19 & 31) << 10;
}

// The colours that a picture has most of, and for each colour that it has the nearest of them.
class Palette {
 public:
  void choose(const images::Image& image) {
    counts_.assign(kBuckets, 0);
    nearest_.resize(kBuckets);
    for (const std::uint32_t pixel : image.pixels) ++counts_[bucket_of(pixel)];
    used_.clear();
    for (std::size_t bucket = 0; bucket < kBuckets; ++bucket)
      if (counts_[bucket] > 0) used_.push_back(static_cast<std::uint16_t>(bucket));
    const std::size_t chosen = std::min(used_.size(), kColors);
    std::partial_sort(used_.begin(), used_.begin() + static_cast<std::ptrdiff_t>(chosen), used_.end(),
                      [this](std::uint16_t a, std::uint16_t b) {
                        return counts_[a] != counts_[b] ? counts_[a] > counts_[b] : a < b;
                      });
    colors_.assign(used_.begin(), used_.begin() + static_cast<std::ptrdiff_t>(chosen));
    for (std::size_t i = 0; i < chosen; ++i) nearest_[used_[i]] = static_cast<std::uint8_t>(i);
    for (std::size_t i = chosen; i < used_.size(); ++i) nearest_[used_[i]] = find_nearest(used_[i]);
  }

  std::uint8_t number_of(std::uint32_t pixel) const { return nearest_[bucket_of(pixel)]; }
  std::size_t size() const { return colors_.size(); }
  // In hundredths, as sixel has it; channel 0 is red.
  int part(std::size_t color, int channel) const { return channel_of(colors_[color], channel) * 100 / 31; }

 private:
  static int channel_of(std::uint16_t bucket, int channel) { return bucket >> 5 * channel & 31; }

  std::uint8_t find_nearest(std::uint16_t bucket) const {
    std::size_t best = 0;
    int least = 1 << 30;
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      int distance = 0;
      for (int channel = 0; channel < 3; ++channel) {
        const int apart = channel_of(bucket, channel) - channel_of(colors_[i], channel);
        distance += apart * apart;
      }
      if (distance < least) {
        least = distance;
        best = i;
      }
    }
    return static_cast<std::uint8_t>(best);
  }

  std::vector<std::uint32_t> counts_;
  std::vector<std::uint16_t> used_, colors_;
  std::vector<std::uint8_t> nearest_;
};

class Sixel : public TerminalPicture {
 public:
  // One line less than there is: a picture that reaches the last one would scroll.
  images::PictureSize space(const Terminal& terminal, std::uint32_t lines) const override {
    const images::PictureSize cells = terminal.cells(), cell = terminal.cell();
    return {cells.width * cell.width, (cells.height > lines + 1 ? cells.height - lines - 1 : 1) * cell.height};
  }

  const std::string& shown(const images::Image& image) override {
    palette_.choose(image);
    text_ = "\x1b[?2026h\x1b[H\x1bP0;1q\"1;1;";
    add_number(image.width);
    text_ += ';';
    add_number(image.height);
    for (std::size_t color = 0; color < palette_.size(); ++color) {
      text_ += '#';
      add_number(static_cast<std::uint32_t>(color));
      text_ += ";2";
      for (int channel = 0; channel < 3; ++channel) {
        text_ += ';';
        add_number(static_cast<std::uint32_t>(palette_.part(color, channel)));
      }
    }
    for (std::uint32_t top = 0; top < image.height; top += 6) add_band(image, top);
    text_ += "\x1b\\\x1b[?2026l";
    return text_;
  }

 private:
  // Six rows: for each colour that is in them, a character of six bits for every column.
  void add_band(const images::Image& image, std::uint32_t top) {
    masks_.resize(palette_.size());
    std::array<bool, 256> seen{};
    present_.clear();
    const std::uint32_t rows = std::min(6u, image.height - top);
    for (std::uint32_t row = 0; row < rows; ++row) {
      const std::uint32_t* pixels = &image.pixels[std::size_t{top + row} * image.width];
      for (std::uint32_t x = 0; x < image.width; ++x) {
        const std::uint8_t color = palette_.number_of(pixels[x]);
        if (!seen[color]) {
          seen[color] = true;
          present_.push_back(color);
          masks_[color].assign(image.width, 0);
        }
        masks_[color][x] |= static_cast<char>(1 << row);
      }
    }
    for (const std::uint8_t color : present_) {
      text_ += '#';
      add_number(color);
      add_runs(masks_[color]);
      text_ += '$';
    }
    text_.back() = '-';
  }

  void add_runs(const std::vector<char>& masks) {
    std::size_t end = masks.size();
    while (end > 0 && masks[end - 1] == 0) --end;
    for (std::size_t at = 0; at < end;) {
      std::size_t next = at + 1;
      while (next < end && masks[next] == masks[at]) ++next;
      if (next - at > 3) {
        text_ += '!';
        add_number(static_cast<std::uint32_t>(next - at));
        text_ += static_cast<char>(63 + masks[at]);
      } else {
        text_.append(next - at, static_cast<char>(63 + masks[at]));
      }
      at = next;
    }
  }

  void add_number(std::uint32_t number) {
    std::array<char, 10> digits;
    text_.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
  }

  Palette palette_;
  std::vector<std::vector<char>> masks_;
  std::vector<std::uint8_t> present_;
  std::string text_;
};

}  // namespace

std::unique_ptr<TerminalPicture> make_sixel() { return std::make_unique<Sixel>(); }

}  // namespace mars::preview
