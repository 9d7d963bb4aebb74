// What stands still in an interval, for the inbetweens that the group's nodes on a machine draw: the records of all
// bands, and the pixels of those bands in which inbetweens may draw. Lies in memory that these nodes share; a band is
// written by one node while no other reads, as node/wire/frame_writer.h says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "host/images/picture_bands.h"
#include "host/render/composer/band_record.h"

namespace mars::composer {

class IntervalBackground {
 public:
  explicit IntervalBackground(const images::PictureBands& bands);

  // Pages are used as bands are written.
  std::size_t bytes() const { return band_bytes() * bands_.count(); }
  // Of a band at most.
  std::size_t band_bytes() const { return pixel_bytes_ + slot_bytes_; }
  void use(std::span<std::byte> memory) { memory_ = memory; }

  // A record, and the band's pixels or none of them.
  void put(const BandRecord& record, std::span<const std::byte> pixels);
  // None where the band is not there, or of another interval.
  std::optional<BandRecord> record(std::uint32_t band, std::uint32_t interval) const;
  // Words of the band's pixels, which were put.
  std::span<const std::uint32_t> pixels(std::uint32_t band) const;

 private:
  std::byte* slot(std::uint32_t band) const {
    return memory_.data() + pixel_bytes_ * bands_.count() + slot_bytes_ * band;
  }

  const images::PictureBands bands_;
  const std::size_t pixel_bytes_, slot_bytes_;  // of a band
  std::span<std::byte> memory_;
};

}  // namespace mars::composer
