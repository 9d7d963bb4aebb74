#include "host/studio/web/picture_message.h"

#include <turbojpeg.h>
#include <zlib.h>

#include <cstring>
#include <memory>
#include <span>
#include <string>

#include "hal/failure/failure.h"

namespace mars::web {
namespace {

using studio::ViewPicture;

constexpr std::uint32_t kMagic = 0x5352414d;
constexpr int kJpegQuality = 80;
enum Flags : std::uint16_t { kRests = 1, kExact = 2 };

struct Head {
  std::uint32_t magic = kMagic;
  std::uint32_t view, picture;
  std::uint32_t edit_low, edit_high;
  std::uint16_t width, height;
  std::uint16_t encoding, flags;
  std::uint32_t rects;
};
static_assert(sizeof(Head) == 32 && sizeof(pictures::Rect) == 8, "pixels begin at a multiple of 8 bytes");

void append(std::string& message, std::span<const std::byte> bytes) {
  message.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

Head head_of(const ViewPicture& picture, Encoding encoding) {
  const bool exact = picture.exact && encoding != Encoding::jpeg;
  return {.view = picture.view,
          .picture = picture.picture,
          .edit_low = static_cast<std::uint32_t>(picture.edit),
          .edit_high = static_cast<std::uint32_t>(picture.edit >> 32),
          .width = picture.width,
          .height = picture.height,
          .encoding = static_cast<std::uint16_t>(encoding),
          .flags = static_cast<std::uint16_t>((picture.rests ? kRests : 0) | (exact ? kExact : 0)),
          .rects = static_cast<std::uint32_t>(picture.rects.size())};
}

void append_deflated(std::string& message, std::span<const std::byte> pixels) {
  const std::size_t before = message.size();
  uLongf bytes = compressBound(pixels.size());
  message.resize(before + bytes);
  const int result = compress2(reinterpret_cast<Bytef*>(message.data() + before), &bytes,
                               reinterpret_cast<const Bytef*>(pixels.data()), pixels.size(), Z_BEST_SPEED);
  check(result == Z_OK, "zlib deflates a picture into a buffer of compressBound bytes");
  message.resize(before + bytes);
}

void append_jpeg(std::string& message, const ViewPicture& picture) {
  const std::unique_ptr<void, decltype(&tjDestroy)> encoder(tjInitCompress(), &tjDestroy);
  if (!encoder) throw Failure("a picture could not be encoded as JPEG", tjGetErrorStr(), "");
  const std::size_t before = message.size();
  unsigned long bytes = tjBufSize(picture.width, picture.height, TJSAMP_420);
  message.resize(before + bytes);
  auto* at = reinterpret_cast<unsigned char*>(message.data() + before);
  if (tjCompress2(encoder.get(), reinterpret_cast<const unsigned char*>(picture.pixels.data()), picture.width, 0,
                  picture.height, TJPF_RGBX, &at, &bytes, TJSAMP_420, kJpegQuality, TJFLAG_NOREALLOC) != 0)
    throw Failure("a picture could not be encoded as JPEG", tjGetErrorStr2(encoder.get()), "");
  message.resize(before + bytes);
}

}  // namespace

bool is_whole(const ViewPicture& picture) {
  if (picture.rects.size() != 1) return false;
  const pictures::Rect& rect = picture.rects.front();
  return rect.x == 0 && rect.y == 0 && rect.width == picture.width && rect.height == picture.height;
}

std::string picture_message(const ViewPicture& picture, Encoding encoding) {
  check(encoding != Encoding::jpeg || is_whole(picture), "only whole pictures are JPEG");
  const std::span<const std::byte> pixels = std::as_bytes(std::span(picture.pixels));
  const Head head = head_of(picture, encoding);
  std::string message;
  append(message, std::as_bytes(std::span(&head, 1)));
  append(message, std::as_bytes(std::span(picture.rects)));
  switch (encoding) {
    case Encoding::raw: append(message, pixels); break;
    case Encoding::deflate: append_deflated(message, pixels); break;
    case Encoding::jpeg: append_jpeg(message, picture); break;
  }
  return message;
}

}  // namespace mars::web
