#include "host/render/composer/band_record.h"

#include <algorithm>
#include <cstring>

#include "host/images/encode_bands.h"
#include "host/render/sinks/pixel_hash.h"

namespace mars::composer {
namespace {

constexpr std::size_t kAlign = 8;

std::size_t round_up(std::size_t bytes) { return (bytes + kAlign - 1) / kAlign * kAlign; }

}  // namespace

// Random pixels make files that are larger than their pixels: a word of DEFLATE has at most 15 bits for 8.
std::size_t most_record_bytes(const images::PictureBands& bands) {
  constexpr std::size_t kBesides = 4096;
  const images::Lines lines = bands.lines_of(0);
  const std::size_t words = std::max(bands.words_of(lines), images::file_words_of(bands, lines));
  const std::size_t pixels = words * sizeof(std::uint32_t);
  return sizeof(BandHead) + round_up(2 * pixels + lines.count() * std::size_t{16} + kBesides);
}

void append_record(std::vector<std::byte>& to, const images::PictureBands& bands, std::uint32_t band,
                   std::uint32_t interval, std::span<const std::uint32_t> pixels) {
  const images::FilePixels file(bands, pixels);
  const images::EncodedBand encoded = images::encode_band(bands, band, file.words());
  BandHead head{band, interval, encoded.adler32, 0, encoded.row_bytes, encoded.bytes.size(), 0, {}};
  const std::string hash = sinks::hash_of_band(file.words());
  std::copy_n(hash.begin(), std::min(hash.size(), sizeof head.hash), head.hash);
  const std::size_t at = to.size();
  to.resize(at + sizeof head + round_up(encoded.bytes.size()));
  std::memcpy(to.data() + at, &head, sizeof head);
  std::ranges::copy(encoded.bytes, to.begin() + static_cast<std::ptrdiff_t>(at + sizeof head));
}

std::optional<ReadRecord> take_record(std::span<const std::byte>& bytes, const images::PictureBands& bands) {
  ReadRecord read;
  BandHead& head = read.record.head;
  if (bytes.size() < sizeof head) return std::nullopt;
  std::memcpy(&head, bytes.data(), sizeof head);
  bytes = bytes.subspan(sizeof head);
  if (head.band >= bands.count() || head.bytes > bytes.size() || round_up(head.bytes) > bytes.size())
    return std::nullopt;
  read.record.encoded = bytes.first(head.bytes);
  bytes = bytes.subspan(round_up(head.bytes));
  const std::size_t words = bands.words_of(bands.lines_of(head.band));
  if (head.pixels != 0 && (head.pixels != words || bytes.size() / sizeof(std::uint32_t) < words)) return std::nullopt;
  read.pixels = bytes.first(head.pixels * sizeof(std::uint32_t));
  bytes = bytes.subspan(std::min(bytes.size(), round_up(read.pixels.size())));
  return read;
}

}  // namespace mars::composer
