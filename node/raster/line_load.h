// What there is to draw on a scanline, counted while triangles are set up: its edge boxes and the samples that they
// cover, hidden ones too. Both are in one number of 64 bits, so that one addition counts both, and a group of nodes
// sums one number a line. Kernels of several instruction sets share it: what they call is always inlined, so that none
// leaves a copy for the linker to take.
#pragma once

#include <cstdint>

namespace mars::raster {

class LineLoad {
 public:
  // Of one line, of all nodes together. Beyond, one count spills into the other or is lost; GroupSums finds that.
  static constexpr std::uint64_t kMostBoxes = (std::uint64_t{1} << 28) - 1;
  static constexpr std::uint64_t kMostSamples = (std::uint64_t{1} << 36) - 1;

  constexpr LineLoad() = default;
  [[gnu::always_inline]] constexpr LineLoad(std::uint64_t boxes, std::uint64_t samples)
      : packed_(boxes << kSampleBits | samples) {}
  // As nodes sum it.
  static constexpr LineLoad of_packed(std::uint64_t packed) {
    LineLoad load;
    load.packed_ = packed;
    return load;
  }
  constexpr std::uint64_t packed() const { return packed_; }

  constexpr std::uint64_t boxes() const { return packed_ >> kSampleBits; }
  constexpr std::uint64_t samples() const { return packed_ & kMostSamples; }

  [[gnu::always_inline]] constexpr LineLoad& operator+=(const LineLoad& other) {
    packed_ += other.packed_;
    return *this;
  }
  constexpr bool operator==(const LineLoad&) const = default;

 private:
  static constexpr int kSampleBits = 36;

  std::uint64_t packed_ = 0;
};
static_assert(sizeof(LineLoad) == sizeof(std::uint64_t));

}  // namespace mars::raster
