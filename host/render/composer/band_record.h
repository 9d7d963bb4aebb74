// What a file needs of one band, and its hash, as one piece of bytes that travels and lies in shared memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/images/picture_bands.h"

namespace mars::composer {

struct BandHead {
  std::uint32_t band;
  std::uint32_t interval;  // whose
  std::uint32_t adler32;   // as in images::EncodedBand
  std::uint32_t unused;
  std::uint64_t row_bytes;
  std::uint64_t bytes;   // of the encoded band, which follow
  std::uint64_t pixels;  // words that follow these; in messages about backgrounds
  char hash[32];         // of the band's pixels, as digits
};

// Within a message or memory, which outlives it.
struct BandRecord {
  BandHead head{};
  std::span<const std::byte> encoded;
};

// Of the bands of such pictures a record takes no more.
std::size_t most_record_bytes(const images::PictureBands& bands);

// Hashes and encodes a band's pixels; appends the record.
void append_record(std::vector<std::byte>& to, const images::PictureBands& bands, std::uint32_t band,
                   std::uint32_t interval, std::span<const std::uint32_t> pixels);

// The record with which `bytes` begin, and its pixels; both are cut off from the bytes. None where that is no whole
// record of a band of such pictures.
struct ReadRecord {
  BandRecord record;
  std::span<const std::byte> pixels;
};
std::optional<ReadRecord> take_record(std::span<const std::byte>& bytes, const images::PictureBands& bands);

}  // namespace mars::composer
