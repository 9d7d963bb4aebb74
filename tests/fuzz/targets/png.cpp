// PNG files. The input changes a sound one, whose sums of chunks are then made right again; or is the file itself.
#include <array>
#include <bit>
#include <cstring>
#include <numeric>

#include "host/images/picture_file.h"
#include "host/images/png_file.h"
#include "tests/fuzz/edits.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::png {
namespace {

constexpr const char* kNote = "a note";
constexpr std::size_t kSignature = 8, kChunkHead = 8, kSum = 4;

std::uint32_t crc_of(const std::byte* from, std::size_t count) {
  std::uint32_t crc = ~0u;
  for (std::size_t i = 0; i < count; ++i) {
    crc ^= static_cast<std::uint32_t>(from[i]);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320u : 0);
  }
  return ~crc;
}

std::uint32_t big_endian(const std::byte* from) {
  std::uint32_t number;
  std::memcpy(&number, from, sizeof number);
  return __builtin_bswap32(number);
}

void set_sums(Message& file) {
  for (std::size_t at = kSignature; at + kChunkHead + kSum <= file.size();) {
    const std::size_t length = big_endian(&file[at]);
    if (length > file.size() - at - kChunkHead - kSum) return;
    const std::uint32_t crc = __builtin_bswap32(crc_of(&file[at + 4], length + 4));
    std::memcpy(&file[at + kChunkHead + length], &crc, sizeof crc);
    at += kChunkHead + length + kSum;
  }
}

Message sound(bool two_words) {
  std::vector<std::uint32_t> pixels(two_words ? 7 * 5 * 2 : 7 * 5);
  std::iota(pixels.begin(), pixels.end(), 0x00102030u);
  return images::encode_picture(two_words ? images::PictureFormat::png16 : images::PictureFormat::png, 7, 5, pixels,
                                kNote);
}

}  // namespace

void take(std::string_view input) {
  static const std::array<Message, 2> files{sound(false), sound(true)};
  if (input.starts_with("\x89PNG")) {
    images::note_in_png(std::as_bytes(std::span(input)));
    images::decode_png(std::as_bytes(std::span(input)), "frame.png");
    return;
  }
  Script script(input);
  Message file = files[script.below(2)];
  while (!script.at_end()) edit(file, script, 4096);
  set_sums(file);
  images::note_in_png(file);
  if (script.below(2) == 0)
    images::decode_png(file, "frame.png");
  else
    images::decode_png16(file, "frame.png");
}

const Target target("png", Form::bytes, take);

}  // namespace mars::fuzz::png
