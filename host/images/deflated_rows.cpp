#include "host/images/deflated_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>

#include "hal/failure/failure.h"
#include "host/images/huffman_code.h"

namespace mars::images {
namespace {

static_assert(std::endian::native == std::endian::little);

// DEFLATE's alphabets (RFC 1951, 3.2.5 and 3.2.7).
constexpr std::size_t kLiterals = 256, kEndOfBlock = 256, kFirstLength = 257, kSymbols = 286;
constexpr std::uint32_t kLongestRepeat = 258;  // bytes
constexpr std::uint32_t kLongestWord = 15, kLongestLengthWord = 7;
constexpr std::array<std::uint16_t, 29> kLengths{3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                                 31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr std::array<std::uint8_t, 29> kExtraBits{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                                  2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
constexpr std::array<std::uint8_t, 19> kOrderOfLengths{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                       11, 4,  12, 3, 13, 2, 14, 1, 15};

enum Filter : std::uint8_t { kSub = 1, kUp = 2 };  // PNG's

// How a pixel lies in a filtered row: its bytes, the first of them lowest.
struct Rgb8 {
  using Pixel = std::uint32_t;
  static constexpr std::uint32_t kBytes = 3, kWords = 1;
  static constexpr Pixel kEachByte = 0x010101;
  static constexpr std::uint32_t kDistanceSymbol = 2, kDistanceExtra = 0, kDistanceExtraBits = 0;  // 3 bytes
  static Pixel in_file_order(Pixel pixel) { return pixel & 0xffffff; }
};

struct Rgb16 {
  using Pixel = std::uint64_t;
  static constexpr std::uint32_t kBytes = 6, kWords = 2;
  static constexpr Pixel kEachByte = 0x010101010101;
  static constexpr std::uint32_t kDistanceSymbol = 4, kDistanceExtra = 1, kDistanceExtraBits = 1;  // 6 bytes
  static Pixel in_file_order(Pixel pixel) {  // PNG has the higher byte of a channel first
    constexpr Pixel kLow = 0x00ff00ff00ff;
    return (pixel & kLow) << 8 | ((pixel >> 8) & kLow);
  }
};

// With alpha. Pixels have room for a token's kind beside their bytes.
struct Rgba8 {
  using Pixel = std::uint64_t;
  static constexpr std::uint32_t kBytes = 4, kWords = 1;
  static constexpr Pixel kEachByte = 0x01010101;
  static constexpr std::uint32_t kDistanceSymbol = 3, kDistanceExtra = 0, kDistanceExtraBits = 0;  // 4 bytes
  static Pixel in_file_order(Pixel pixel) { return pixel & 0xffffffff; }
};

struct Rgba16 {
  __extension__ using Pixel = unsigned __int128;
  static constexpr std::uint32_t kBytes = 8, kWords = 2;
  static constexpr Pixel kEachByte = 0x0101010101010101;
  static constexpr std::uint32_t kDistanceSymbol = 5, kDistanceExtra = 1, kDistanceExtraBits = 1;  // 8 bytes
  static Pixel in_file_order(Pixel pixel) {
    constexpr Pixel kLow = 0x00ff00ff00ff00ff;
    return (pixel & kLow) << 8 | ((pixel >> 8) & kLow);
  }
};

// What a band is made of, in the order of the file: a pixel's bytes; one byte; the last pixel again, or the last byte,
// as often as `count` pixels have bytes, but for the byte that is there already. Kind and value share a word.
template <typename Rgb>
struct Tokens {
  using Token = typename Rgb::Pixel;
  static constexpr Token kKind = Token{3} << (8 * sizeof(Token) - 2);
  static constexpr Token kPixel = 0, kByte = Token{1} << (8 * sizeof(Token) - 2), kPixelAgain = kByte * 2,
                         kByteAgain = kByte * 3;
};

struct LengthSymbol {
  std::uint32_t symbol, extra, extra_bits;
};

constexpr LengthSymbol symbol_of_length(std::uint32_t length) {
  std::size_t k = kLengths.size() - 1;
  while (kLengths[k] > length) --k;
  return {static_cast<std::uint32_t>(kFirstLength + k), length - kLengths[k], kExtraBits[k]};
}

class BitWriter {
 public:
  explicit BitWriter(std::byte* to) : to_(to) {}

  // At most 56 bits before flush().
  void put(std::uint64_t bits, std::uint32_t count) {
    bits_ |= bits << count_;
    count_ += count;
  }
  // Leaves less than a byte. Writes up to eight bytes beyond its end.
  void flush() {
    std::memcpy(to_, &bits_, sizeof bits_);
    to_ += count_ / 8;
    bits_ >>= count_ & ~7u;
    count_ &= 7;
  }
  // An empty block that is not compressed, as zlib ends a full flush: what follows begins with a whole byte.
  void end_on_byte() {
    put(0, 3);
    flush();
    if (count_ > 0) put(0, 8 - count_);
    put(0xffff0000, 32);
    flush();
  }
  std::byte* end() const { return to_; }

 private:
  std::byte* to_;
  std::uint64_t bits_ = 0;
  std::uint32_t count_ = 0;
};

// Of some bytes: of all, and with the last counted once, the one before twice ...
struct ByteSums {
  std::uint64_t all, weighted;
};

// RFC 1950, over rows whose sums stay far below 64 bits.
class Adler32 {
 public:
  void add(std::uint64_t byte) {
    a_ += byte;
    b_ += a_;
  }
  // `bytes` bytes that have the sums; `count` times.
  void add(std::uint64_t bytes, const ByteSums& sums) {
    b_ += bytes * a_ + sums.weighted;
    a_ += sums.all;
  }
  void repeat(std::uint64_t count, std::uint64_t bytes, const ByteSums& sums) {
    b_ += count * (bytes * a_ + sums.weighted) + bytes * sums.all * (count * (count - 1) / 2);
    a_ += count * sums.all;
  }
  void end_row() {
    a_ %= kModulus;
    b_ %= kModulus;
  }
  std::uint32_t value() const { return static_cast<std::uint32_t>(b_ << 16 | a_); }

 private:
  static constexpr std::uint64_t kModulus = 65521;
  std::uint64_t a_ = 1, b_ = 0;
};

template <typename Rgb>
class Band {
 public:
  using Pixel = typename Rgb::Pixel;

  Band(std::span<const std::uint32_t> pixels, std::size_t width)
      : width_(width),
        height_(pixels.size() / (width * Rgb::kWords)),
        filtered_(width + 1),
        tokens_(std::make_unique_for_overwrite<Pixel[]>((width + 1) * height_)) {
    for (std::size_t y = 0; y < height_; ++y) {
      filter(pixels.data() + y * width_ * Rgb::kWords, y == 0);
      add_row(y == 0 ? kSub : kUp);
    }
  }

  DeflatedRows deflate() const {
    const std::size_t most = count_ * (Rgb::kBytes * kLongestWord / 8 + 1) + kRoomForHead;
    const auto room = std::make_unique_for_overwrite<std::byte[]>(most);
    BitWriter out(room.get());
    const HuffmanCode code = huffman_code(all_counts(), kLongestWord);
    write_head(code, out);
    write_tokens(code, out);
    out.end_on_byte();
    return {{room.get(), out.end()}, adler_.value(), (width_ * Rgb::kBytes + 1) * height_};
  }

 private:
  using T = Tokens<Rgb>;
  using Counts = std::array<std::uint32_t, kSymbols>;
  static constexpr std::uint32_t kMostPixels = kLongestRepeat / Rgb::kBytes;  // in one repeat
  static constexpr std::size_t kRoomForHead = 1024;

  static constexpr auto kPixelsAgain = [] {
    std::array<LengthSymbol, kMostPixels + 1> symbols{};
    for (std::uint32_t n = 1; n <= kMostPixels; ++n) symbols[n] = symbol_of_length(n * Rgb::kBytes);
    return symbols;
  }();
  static constexpr auto kBytesAgain = [] {
    std::array<LengthSymbol, kMostPixels + 1> symbols{};
    for (std::uint32_t n = 2; n <= kMostPixels; ++n) symbols[n] = symbol_of_length(n * Rgb::kBytes - 1);
    return symbols;
  }();

  // Each byte less the one to the left, or above.
  void filter(const std::uint32_t* row, bool is_first) {
    const std::size_t back = is_first ? 1 : width_;
    if (is_first) filtered_[0] = Rgb::in_file_order(pixel_at(row, 0));
    for (std::size_t x = is_first ? 1 : 0; x < width_; ++x) {
      const Pixel before = pixel_at(row - back * Rgb::kWords, x);
      filtered_[x] = Rgb::in_file_order(difference(pixel_at(row, x), before));
    }
  }

  static Pixel pixel_at(const std::uint32_t* row, std::size_t x) {
    Pixel pixel = 0;
    std::memcpy(&pixel, row + x * Rgb::kWords, Rgb::kWords * sizeof *row);
    return pixel;
  }

  // Byte by byte.
  static Pixel difference(Pixel a, Pixel b) {
    constexpr auto kHighest = static_cast<Pixel>(0x8080808080808080);
    return ((a | kHighest) - (b & ~kHighest)) ^ ((a ^ ~b) & kHighest);
  }

  void add_row(Filter filter) {
    add_byte(filter);
    for (std::size_t x = 0; x < width_;) {
      const Pixel pixel = filtered_[x];
      if (filtered_[x + 1] != pixel || x + 1 == width_) {
        add_pixel(pixel);
        ++x;
        continue;
      }
      const std::size_t end = end_of_run(x);
      add_repeated(pixel, end - x);
      x = end;
    }
    adler_.end_row();
  }

  // One past the pixels from `x` on that are the same, at least two.
  std::size_t end_of_run(std::size_t x) const {
    constexpr std::size_t kAtATime = 8;
    const Pixel* const pixels = filtered_.data();
    std::size_t end = x + 2;
    const auto differ = [&] {
      Pixel all = 0;
      for (std::size_t k = 0; k < kAtATime; ++k) all |= pixels[end + k] ^ pixels[x];
      return all != 0;
    };
    while (end + kAtATime <= width_ && !differ()) end += kAtATime;
    while (end < width_ && pixels[end] == pixels[x]) ++end;
    return end;
  }

  void add_token(Pixel token) { tokens_[count_++] = token; }

  void add_byte(std::uint8_t byte) {
    add_token(T::kByte | byte);
    ++counts_[0][byte];
    adler_.add(byte);
  }

  void add_pixel(Pixel pixel) {
    const ByteSums sums = sums_of(pixel);
    adler_.add(Rgb::kBytes, sums);
    add_literal(pixel);
  }

  void add_literal(Pixel pixel) {
    add_token(pixel);
    for (std::uint32_t k = 0; k < Rgb::kBytes; ++k) ++counts_[k % counts_.size()][(pixel >> 8 * k) & 0xff];
  }

  // `count` times, where another pixel came before.
  void add_repeated(Pixel pixel, std::size_t count) {
    adler_.repeat(count, Rgb::kBytes, sums_of(pixel));
    std::size_t left = count - 1;
    if (pixel == (pixel & 0xff) * Rgb::kEachByte) {
      const auto byte = static_cast<std::uint8_t>(pixel);
      const std::size_t first = std::min<std::size_t>(count, kMostPixels);
      add_token(T::kByte | byte);
      ++counts_[0][byte];
      add_token(T::kByteAgain | static_cast<Pixel>(first));
      ++counts_[0][kBytesAgain[first].symbol];
      left = count - first;
    } else {
      add_literal(pixel);
    }
    while (left > 0) {
      const std::size_t part = std::min<std::size_t>(left, kMostPixels);
      add_token(T::kPixelAgain | static_cast<Pixel>(part));
      ++counts_[0][kPixelsAgain[part].symbol];
      left -= part;
    }
  }

  static ByteSums sums_of(Pixel pixel) {
    ByteSums sums{0, 0};
    for (std::uint32_t k = 0; k < Rgb::kBytes; ++k) {
      sums.all += (pixel >> 8 * k) & 0xff;
      sums.weighted += sums.all;
    }
    return sums;
  }

  Counts all_counts() const {
    Counts all = counts_[0];
    for (std::size_t k = 1; k < counts_.size(); ++k)
      for (std::size_t symbol = 0; symbol < kSymbols; ++symbol) all[symbol] += counts_[k][symbol];
    all[kEndOfBlock] = 1;
    return all;
  }

  // Of one block with a code of its own; of distances there are two, each with a word of one bit.
  static void write_head(const HuffmanCode& code, BitWriter& out) {
    std::size_t symbols = kSymbols;
    while (symbols > kFirstLength && code.lengths[symbols - 1] == 0) --symbols;
    std::vector<std::uint8_t> lengths(code.lengths.begin(),
                                      code.lengths.begin() + static_cast<std::ptrdiff_t>(symbols));
    const std::size_t distances = Rgb::kDistanceSymbol + 1;
    lengths.resize(symbols + distances, 0);
    lengths[symbols] = lengths.back() = 1;
    out.put(0, 1);
    out.put(2, 2);
    out.put(symbols - kFirstLength, 5);
    out.put(distances - 1, 5);
    write_lengths(lengths, out);
  }

  struct LengthToken {
    std::uint8_t symbol, extra, extra_bits;
  };

  // Runs of zeros, and of a length that repeats (RFC 1951, 3.2.7).
  static std::vector<LengthToken> tokens_of(const std::vector<std::uint8_t>& lengths) {
    std::vector<LengthToken> tokens;
    for (std::size_t at = 0; at < lengths.size();) {
      const std::uint8_t length = lengths[at];
      std::size_t run = 1;
      while (at + run < lengths.size() && lengths[at + run] == length) ++run;
      at += run;
      const auto add = [&](std::uint8_t symbol, std::uint8_t extra_bits, std::size_t least, std::size_t most) {
        const std::size_t part = std::min(run, most);
        tokens.push_back({symbol, static_cast<std::uint8_t>(part - least), extra_bits});
        run -= part;
      };
      if (length != 0) add(length, 0, 1, 1);
      while (run > 0) {
        if (length == 0 && run >= 11)
          add(18, 7, 11, 138);
        else if (length == 0 && run >= 3)
          add(17, 3, 3, 10);
        else if (length != 0 && run >= 3)
          add(16, 2, 3, 6);
        else
          add(length, 0, 1, 1);
      }
    }
    return tokens;
  }

  static void write_lengths(const std::vector<std::uint8_t>& lengths, BitWriter& out) {
    const std::vector<LengthToken> tokens = tokens_of(lengths);
    std::array<std::uint32_t, kOrderOfLengths.size()> counts{};
    for (const LengthToken& token : tokens) ++counts[token.symbol];
    const HuffmanCode code = huffman_code(counts, kLongestLengthWord);
    std::size_t written = kOrderOfLengths.size();
    while (written > 4 && code.lengths[kOrderOfLengths[written - 1]] == 0) --written;
    out.put(written - 4, 4);
    out.flush();
    for (std::size_t k = 0; k < written; ++k, out.flush()) out.put(code.lengths[kOrderOfLengths[k]], 3);
    for (const LengthToken& token : tokens) {
      out.put(code.words[token.symbol], code.lengths[token.symbol]);
      out.put(token.extra, token.extra_bits);
      out.flush();
    }
  }

  struct Bits {
    std::uint32_t bits, count;
  };

  // Words of lengths with their extra bits and the distance that follows.
  static std::array<Bits, kMostPixels + 1> repeats(const HuffmanCode& code,
                                                   const std::array<LengthSymbol, kMostPixels + 1>& symbols,
                                                   Bits distance) {
    std::array<Bits, kMostPixels + 1> all{};
    for (std::uint32_t n = 1; n <= kMostPixels; ++n) {
      const auto [symbol, extra, extra_bits] = symbols[n];
      const std::uint32_t length = code.lengths[symbol];
      all[n] = {code.words[symbol] | extra << length | distance.bits << (length + extra_bits),
                length + extra_bits + distance.count};
    }
    return all;
  }

  // As many at a time as a flush takes.
  static void write_literals(Pixel pixel, const std::array<Bits, kLiterals>& literals, BitWriter& out) {
    constexpr std::uint32_t kThree = Rgb::kBytes / 3 * 3;
    for (std::uint32_t k = 0; k < kThree; k += 3) {
      const Bits &a = literals[(pixel >> 8 * k) & 0xff], &b = literals[(pixel >> 8 * (k + 1)) & 0xff],
                 &c = literals[(pixel >> 8 * (k + 2)) & 0xff];
      out.put(a.bits | std::uint64_t{b.bits} << a.count | std::uint64_t{c.bits} << (a.count + b.count),
              a.count + b.count + c.count);
      out.flush();
    }
    for (std::uint32_t k = kThree; k < Rgb::kBytes; ++k) {
      const Bits& rest = literals[(pixel >> 8 * k) & 0xff];
      out.put(rest.bits, rest.count);
      if (k + 1 == Rgb::kBytes) out.flush();
    }
  }

  void write_tokens(const HuffmanCode& code, BitWriter& out) const {
    const auto bytes_again = repeats(code, kBytesAgain, {0, 1});
    const auto pixels_again = repeats(code, kPixelsAgain, {1 | Rgb::kDistanceExtra << 1, 1 + Rgb::kDistanceExtraBits});
    std::array<Bits, kLiterals> literals;
    for (std::size_t k = 0; k < kLiterals; ++k) literals[k] = {code.words[k], code.lengths[k]};
    const auto put = [&out](const Bits& bits) { out.put(bits.bits, bits.count); };
    for (const Pixel token : std::span(tokens_.get(), count_)) {
      const Pixel value = token & ~T::kKind;
      switch (token & T::kKind) {
        case T::kPixel: write_literals(value, literals, out); continue;
        case T::kByte: put(literals[value]); break;
        case T::kPixelAgain: put(pixels_again[value]); break;
        default: put(bytes_again[value]);
      }
      out.flush();
    }
    out.put(code.words[kEndOfBlock], code.lengths[kEndOfBlock]);
    out.flush();
  }

  const std::size_t width_, height_;
  std::vector<Pixel> filtered_;  // a row, and one
  std::unique_ptr<Pixel[]> tokens_;
  std::size_t count_ = 0;           // of them
  std::array<Counts, 3> counts_{};  // of symbols; several, so that they do not wait for each other
  Adler32 adler_;
};

}  // namespace

DeflatedRows deflate_rows(std::span<const std::uint32_t> pixels, std::size_t width, wire::PixelFormat format) {
  check(width > 0 && pixels.size() % (width * wire::pixel_words(format)) == 0, "rows are whole");
  switch (format) {
    case wire::PixelFormat::rgb8: return Band<Rgb8>(pixels, width).deflate();
    case wire::PixelFormat::rgba8: return Band<Rgba8>(pixels, width).deflate();
    case wire::PixelFormat::rgba16: return Band<Rgba16>(pixels, width).deflate();
    default: return Band<Rgb16>(pixels, width).deflate();
  }
}

}  // namespace mars::images
