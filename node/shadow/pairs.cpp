#include "node/shadow/pairs.h"

#include <bit>

#include "hal/failure/failure.h"
#include "node/shadow/light_view.h"
#include "node/shape/vertices.h"

namespace mars::shadow {
namespace {

constexpr std::uint32_t kStrata = 16;  // of a light's points, of which each pixel has one point
constexpr std::uint32_t kChoices = kLightPoints / kStrata;
constexpr std::uint32_t kSquare = 4;  // pixels

}  // namespace

std::uint32_t pairs_of(std::uint32_t sample_bits, std::uint32_t pairs_a_sample) {
  if (pairs_a_sample == 1) return sample_bits;
  const std::uint32_t all = (1u << pairs_a_sample) - 1;
  std::uint32_t pairs = 0;
  for (; sample_bits != 0; sample_bits &= sample_bits - 1)
    pairs |= all << (static_cast<std::uint32_t>(std::countr_zero(sample_bits)) * pairs_a_sample);
  return pairs;
}

// Points are numbered along one axis of the light, so that a stratum is four neighbours there, which lie in four
// quarters of the other axis. Neighbouring pixels differ in the quarters that their strata use, and in the samples that
// have these strata.
std::uint32_t point_of_pair(std::uint32_t column, std::uint32_t line, std::uint32_t pair) {
  const std::uint32_t x = column % kSquare, y = line % kSquare;
  const std::uint32_t stratum = (pair * 5 + 3 * x + 7 * y) % kStrata;
  const std::uint32_t choice = (stratum + (stratum / kChoices) * (1 + 2 * (y & 1)) + x + 2 * y) % kChoices;
  return stratum * kChoices + choice;
}

static_assert(kTile * kTile * kPairs / kLightPoints == kPointLanes,
              "a square has one vector for each point of a light");

PairVectors::PairVectors(const shape::SamplePattern& pattern, bool has_size) {
  const auto samples = static_cast<std::uint32_t>(pattern.count);
  vectors_ = has_size ? 1 : kTile * kTile * samples / kPointLanes;
  if (has_size) {
    lanes_.resize(kLightPoints);
    std::array<std::uint32_t, kLightPoints> count{};
    for (std::uint32_t line = 0; line < kTile; ++line)
      for (std::uint32_t column = 0; column < kTile; ++column)
        for (std::uint32_t pair = 0; pair < kPairs; ++pair) {
          const std::uint32_t point = point_of_pair(column, line, pair);
          check(count[point] < kPointLanes, "each point of a light is used equally often");
          lanes_[point].lane[count[point]++] = lane_of(column, line, pair / (kPairs / samples), pair);
        }
  } else {
    lanes_.resize(vectors_);
    for (std::uint32_t v = 0; v < vectors_; ++v)
      for (std::uint32_t k = 0; k < kPointLanes; ++k) {
        const std::uint32_t square = v / samples, sample = v % samples;
        lanes_[v].lane[k] =
            lane_of(square % 2 * kSquare + k % kSquare, square / 2 * kSquare + k / kSquare, sample, sample);
      }
  }
  place(pattern);
}

Lane PairVectors::lane_of(std::uint32_t column, std::uint32_t line, std::uint32_t sample, std::uint32_t pair) {
  return {static_cast<std::uint8_t>(column), static_cast<std::uint8_t>(line), static_cast<std::uint8_t>(sample),
          static_cast<std::uint8_t>(pair)};
}

void PairVectors::place(const shape::SamplePattern& pattern) {
  constexpr float kPixel = 1.0f / shape::kSubpixels;
  for (VectorLanes& lanes : lanes_)
    for (std::size_t k = 0; k < kPointLanes; ++k) {
      const Lane& lane = lanes.lane[k];
      lanes.place.x[k] = static_cast<float>(lane.column) + static_cast<float>(pattern.x[lane.sample]) * kPixel;
      lanes.place.y[k] = static_cast<float>(lane.line) + static_cast<float>(pattern.y[lane.sample]) * kPixel;
    }
}

}  // namespace mars::shadow
