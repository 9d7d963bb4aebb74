#include "host/images/png_file.h"

#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <string>
#include <string_view>

#include "hal/failure/failure.h"
#include "node/wire/film_parts.h"

namespace mars::images {

namespace {

// Of the largest picture, not compressed, with 4 channels of 16 bits; the rest is for what else a file holds.
constexpr std::uintmax_t kLargestPng = std::uintmax_t{8} * wire::kMaxSide * wire::kMaxSide + (1 << 24);

constexpr const char* kNoteKeyword = "MARS";
constexpr std::size_t kSignature = 8, kChunkHead = 8, kChunkSum = 4;  // bytes

// libpng leaves a failing call by longjmp, which must not pass a C++ object: the functions between setjmp and
// libpng hold plain data only, and what grows lives with their caller.
struct Trouble {
  char reason[200] = "";
};

void on_error(png_structp png, png_const_charp reason) {
  auto* trouble = static_cast<Trouble*>(png_get_error_ptr(png));
  std::strncpy(trouble->reason, reason, sizeof trouble->reason - 1);
  std::longjmp(*png_set_longjmp_fn(png, std::longjmp, sizeof(std::jmp_buf)), 1);
}

void on_warning(png_structp, png_const_charp) {}

void append_bytes(png_structp png, png_bytep data, std::size_t size) {
  auto* bytes = static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
  const auto* first = reinterpret_cast<const std::byte*>(data);
  bytes->insert(bytes->end(), first, first + size);
}

void nothing_to_flush(png_structp) {}

struct Source {
  const std::byte* next;
  const std::byte* end;
};

void take_bytes(png_structp png, png_bytep data, std::size_t size) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (static_cast<std::size_t>(source->end - source->next) < size) png_error(png, "the file ends too early");
  std::memcpy(data, source->next, size);
  source->next += size;
}

enum class Alpha { left_out, kept };

class Writer {
 public:
  Writer() : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &trouble_, on_error, on_warning)) {
    check(png_ != nullptr, "libpng starts");
    info_ = png_create_info_struct(png_);
  }
  ~Writer() { png_destroy_write_struct(&png_, &info_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  // `depth`: bits a channel. `row` has 3 * width of them.
  bool encode(std::uint32_t width, std::uint32_t height, int depth, const std::uint32_t* pixels, png_bytep row,
              png_textp note, std::vector<std::byte>* bytes) {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_write_fn(png_, bytes, append_bytes, nothing_to_flush);
    png_set_IHDR(png_, info_, width, height, depth, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
    if (note != nullptr) png_set_text(png_, info_, note, 1);
    // Measured on frames of 1920x1080: 21 to 28 ms, the SUB filter with zlib's default strategy 24 to 40 ms,
    // libpng's own choices above 160 ms; the file is smaller than SUB's.
    png_set_compression_level(png_, 1);
    png_set_compression_strategy(png_, Z_RLE);
    png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_write_info(png_, info_);
    for (std::size_t line = 0; line < height; ++line) {
      if (depth == 8)
        pack_row(pixels + line * width, width, row);
      else
        pack_row16(pixels + 2 * line * width, width, row);
      png_write_row(png_, row);
    }
    png_write_end(png_, info_);
    return true;
  }

  const char* reason() const { return trouble_.reason; }

 private:
  static void pack_row(const std::uint32_t* pixels, std::uint32_t width, png_bytep row) {
    for (std::uint32_t x = 0; x < width; ++x) {
      row[3 * x] = static_cast<png_byte>(pixels[x]);
      row[3 * x + 1] = static_cast<png_byte>(pixels[x] >> 8);
      row[3 * x + 2] = static_cast<png_byte>(pixels[x] >> 16);
    }
  }

  // PNG has the higher byte first.
  static void pack_row16(const std::uint32_t* words, std::uint32_t width, png_bytep row) {
    for (std::uint32_t x = 0; x < width; ++x) {
      png_save_uint_16(row + 6 * x, words[2 * x] & 0xffff);
      png_save_uint_16(row + 6 * x + 2, words[2 * x] >> 16);
      png_save_uint_16(row + 6 * x + 4, words[2 * x + 1] & 0xffff);
    }
  }

  Trouble trouble_;
  png_structp png_;
  png_infop info_ = nullptr;
};

class Reader {
 public:
  Reader() : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &trouble_, on_error, on_warning)) {
    check(png_ != nullptr, "libpng starts");
    info_ = png_create_info_struct(png_);
  }
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  // Up to the size of the picture and what rows will look like: four channels of `depth` bits a pixel.
  bool begin(Source* source, int depth, Alpha alpha, Image* image) {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_read_fn(png_, source, take_bytes);
    png_set_user_limits(png_, wire::kMaxSide, wire::kMaxSide);
    png_read_info(png_, info_);
    image->width = png_get_image_width(png_, info_);
    image->height = png_get_image_height(png_, info_);
    png_set_expand(png_);
    if (depth == 8) png_set_scale_16(png_);
    if (depth == 16) png_set_expand_16(png_);
    if (depth == 16) png_set_swap(png_);  // the lower byte first
    png_set_gray_to_rgb(png_);
    if (alpha == Alpha::left_out) png_set_strip_alpha(png_);
    png_set_filler(png_, alpha == Alpha::kept ? 255 : 0, PNG_FILLER_AFTER);
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  bool decode(std::size_t row_words, std::uint32_t height, std::uint32_t* pixels) {
    if (setjmp(png_jmpbuf(png_))) return false;
    for (int pass = 0; pass < passes_; ++pass) {
      for (std::size_t line = 0; line < height; ++line) {
        png_read_row(png_, reinterpret_cast<png_bytep>(pixels + line * row_words), nullptr);
      }
    }
    png_read_end(png_, nullptr);
    return true;
  }

  const char* reason() const { return trouble_.reason; }

 private:
  Trouble trouble_;
  png_structp png_;
  png_infop info_ = nullptr;
  int passes_ = 1;
};

png_text text_chunk_of(std::string& keyword, std::string& note) {
  png_text chunk{};
  chunk.compression = PNG_TEXT_COMPRESSION_NONE;
  chunk.key = keyword.data();
  chunk.text = note.data();
  chunk.text_length = note.size();
  return chunk;
}

std::vector<std::byte> encode(std::uint32_t width, std::uint32_t height, int depth,
                              std::span<const std::uint32_t> pixels, std::string note) {
  const auto bytes_a_channel = static_cast<std::size_t>(depth / 8);
  check(pixels.size() == width * height * bytes_a_channel, "a picture has width * height pixels");
  std::vector<png_byte> row(width * 3 * bytes_a_channel);
  std::vector<std::byte> bytes;
  bytes.reserve(pixels.size());
  std::string keyword = kNoteKeyword;
  png_text chunk = text_chunk_of(keyword, note);
  Writer writer;
  if (!writer.encode(width, height, depth, pixels.data(), row.data(), note.empty() ? nullptr : &chunk, &bytes)) {
    throw Failure(std::string("libpng cannot encode a picture: ") + writer.reason(), "", "");
  }
  return bytes;
}

Image decode(std::span<const std::byte> bytes, int depth, Alpha alpha, const std::string& name) {
  const auto torn = [&](const Reader& reader) {
    return Failure(std::string("not a whole PNG picture: ") + reader.reason(), name, "render it again");
  };
  Source source{bytes.data(), bytes.data() + bytes.size()};
  Image image;
  Reader reader;
  if (!reader.begin(&source, depth, alpha, &image)) throw torn(reader);
  const std::size_t row_words = std::size_t{image.width} * static_cast<std::size_t>(depth / 8);
  image.pixels.resize(row_words * image.height);
  if (!reader.decode(row_words, image.height, image.pixels.data())) throw torn(reader);
  return image;
}

}  // namespace

std::vector<std::byte> encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> pixels,
                                  const std::string& note) {
  return encode(width, height, 8, pixels, note);
}

std::vector<std::byte> encode_png16(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> pixels,
                                    const std::string& note) {
  return encode(width, height, 16, pixels, note);
}

std::optional<std::string> note_in_png(std::span<const std::byte> start) {
  const auto* bytes = reinterpret_cast<png_const_bytep>(start.data());
  if (start.size() < kSignature || png_sig_cmp(bytes, 0, kSignature) != 0) return std::nullopt;
  const std::string head = std::string("tEXt") + kNoteKeyword + '\0';
  for (std::size_t at = kSignature; start.size() - at >= kChunkHead + kChunkSum;) {
    const std::size_t length = png_get_uint_32(bytes + at);
    if (length > start.size() - at - kChunkHead - kChunkSum) return std::nullopt;
    const std::string_view chunk(reinterpret_cast<const char*>(bytes + at + 4), length + 4);
    if (chunk.starts_with(head) &&
        png_get_uint_32(bytes + at + kChunkHead + length) == crc32(0, bytes + at + 4, static_cast<uInt>(length + 4)))
      return std::string(chunk.substr(head.size()));
    at += kChunkHead + length + kChunkSum;
  }
  return std::nullopt;
}

Image decode_png(std::span<const std::byte> bytes, const std::string& name) {
  return decode(bytes, 8, Alpha::left_out, name);
}

Image decode_png16(std::span<const std::byte> bytes, const std::string& name) {
  return decode(bytes, 16, Alpha::left_out, name);
}

Image decode_png_with_alpha(std::span<const std::byte> bytes, const std::string& name) {
  return decode(bytes, 8, Alpha::kept, name);
}

}  // namespace mars::images
