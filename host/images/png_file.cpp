#include "host/images/png_file.h"

#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <string>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/images/png_bands.h"
#include "node/wire/film_parts.h"

namespace mars::images {

namespace {

// Of the largest picture, not compressed, with 4 channels of 16 bits; the rest is for what else a file holds.
constexpr std::uintmax_t kLargestPng = std::uintmax_t{8} * wire::kMaxSide * wire::kMaxSide + (1 << 24);

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

struct Reason {
  std::string_view part;  // of libpng's message
  const char* words;
};

constexpr Reason kReasons[] = {{"too early", "it ends too early"},
                               {"ot enough", "it ends too early"},
                               {"CRC", "its bytes have changed since it was written"},
                               {"IHDR", "its header has no size that MARS reads, or no kind of pixels that PNG has"},
                               {"Not a PNG", "it does not begin as one"}};

const char* in_our_words(std::string_view message) {
  for (const Reason& reason : kReasons)
    if (message.find(reason.part) != std::string_view::npos) return reason.words;
  return "its bytes are not as PNG should be";
}

enum class Alpha { left_out, kept };

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
    png_set_filler(png_, alpha == Alpha::kept ? 0xffff : 0, PNG_FILLER_AFTER);
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

Image decode(std::span<const std::byte> bytes, int depth, Alpha alpha, const std::string& name) {
  const auto torn = [&](const Reader& reader) {
    return Failure(std::string("not a whole PNG picture: ") + in_our_words(reader.reason()), name, "render it again");
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

std::optional<std::string> note_in_png(std::span<const std::byte> start) {
  const auto* bytes = reinterpret_cast<png_const_bytep>(start.data());
  if (start.size() < kSignature || png_sig_cmp(bytes, 0, kSignature) != 0) return std::nullopt;
  const std::string head = std::string("tEXt") + kPngNoteKeyword + '\0';
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

Image decode_png16_with_alpha(std::span<const std::byte> bytes, const std::string& name) {
  return decode(bytes, 16, Alpha::kept, name);
}

}  // namespace mars::images
