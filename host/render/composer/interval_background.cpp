#include "host/render/composer/interval_background.h"

#include <algorithm>
#include <cstring>

#include "hal/failure/failure.h"

namespace mars::composer {
namespace {

constexpr std::size_t kPage = 4096;

std::size_t whole_pages(std::size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }

}  // namespace

IntervalBackground::IntervalBackground(const images::PictureBands& bands)
    : bands_(bands),
      pixel_bytes_(whole_pages(bands.words_of(bands.lines_of(0)) * sizeof(std::uint32_t))),
      slot_bytes_(whole_pages(most_record_bytes(bands))) {}

void IntervalBackground::put(const BandRecord& record, std::span<const std::byte> pixels) {
  const std::uint32_t band = record.head.band;
  check(sizeof record.head + record.encoded.size() <= slot_bytes_ && pixels.size() <= pixel_bytes_, "a band fits");
  std::memcpy(slot(band), &record.head, sizeof record.head);
  std::ranges::copy(record.encoded, slot(band) + sizeof record.head);
  std::ranges::copy(pixels, memory_.data() + pixel_bytes_ * band);
}

std::optional<BandRecord> IntervalBackground::record(std::uint32_t band, std::uint32_t interval) const {
  BandRecord record;
  std::memcpy(&record.head, slot(band), sizeof record.head);
  const bool is_it = record.head.band == band && record.head.interval == interval &&
                     record.head.bytes <= slot_bytes_ - sizeof record.head && record.head.bytes > 0;
  if (!is_it) return std::nullopt;
  record.encoded = {slot(band) + sizeof record.head, record.head.bytes};
  return record;
}

std::span<const std::uint32_t> IntervalBackground::pixels(std::uint32_t band) const {
  return {reinterpret_cast<const std::uint32_t*>(memory_.data() + pixel_bytes_ * band),
          bands_.words_of(bands_.lines_of(band))};
}

}  // namespace mars::composer
