#include "node/shadow/pairs.h"

#include <bit>

#include "hal/failure/failure.h"
#include "node/shadow/light_views.h"
#include "node/shape/vertices.h"

namespace mars::shadow {
namespace {

// The points that each pixel of a square uses, row by row of pixels, in the order of pairs. Chosen by how well a
// pixel's points, and those of 2 x 2 pixels together, measure the part of the light on one side of a straight edge,
// over all edges that cross an evenly bright disc, or a ball as it is seen from all sides (light_view.cpp): the minimum
// of an annealing by exchanges. The root of the mean square error is 0.043 for a pixel, 0.020 for 2 x 2; 0.014 (disc)
// and 0.018 (ball) for a square, which uses all. Their order is one in which two, four and eight pairs that follow each
// other do well, too.
constexpr std::uint8_t kPointOfPair[kSquare * kSquare][kPairs] = {
    {61, 2, 9, 40, 15, 62, 19, 34, 49, 4, 42, 27, 36, 37, 47, 14},
    {57, 8, 3, 50, 30, 16, 5, 63, 38, 39, 44, 29, 25, 48, 10, 51},
    {13, 34, 19, 58, 2, 59, 40, 9, 32, 49, 14, 15, 26, 27, 53, 36},
    {24, 25, 10, 51, 29, 44, 47, 46, 5, 56, 22, 39, 58, 3, 57, 8},
    {60, 13, 46, 23, 20, 53, 6, 59, 32, 14, 54, 11, 27, 12, 52, 25},
    {41, 24, 7, 34, 58, 4, 55, 33, 22, 31, 18, 45, 51, 1, 56, 21},
    {30, 47, 37, 20, 11, 60, 0, 46, 35, 12, 42, 23, 48, 17, 2, 61},
    {31, 46, 43, 18, 33, 16, 55, 6, 28, 45, 50, 7, 52, 21, 1, 57},
    {0, 58, 49, 15, 10, 55, 37, 40, 4, 61, 5, 44, 30, 31, 35, 26},
    {0, 62, 19, 28, 39, 38, 41, 16, 29, 36, 48, 17, 3, 50, 6, 59},
    {15, 49, 5, 52, 43, 26, 32, 9, 54, 13, 10, 63, 61, 8, 44, 37},
    {41, 24, 47, 22, 62, 7, 29, 36, 2, 51, 34, 3, 42, 27, 17, 56},
    {14, 59, 57, 20, 52, 13, 38, 39, 60, 11, 8, 33, 9, 32, 18, 35},
    {7, 54, 21, 56, 33, 24, 43, 42, 28, 45, 12, 53, 23, 22, 1, 63},
    {6, 55, 0, 62, 20, 41, 11, 60, 45, 4, 31, 38, 40, 17, 18, 35},
    {63, 1, 43, 26, 53, 12, 23, 54, 28, 21, 48, 25, 50, 19, 30, 16}};

}  // namespace

std::uint32_t pairs_of(std::uint32_t sample_bits, std::uint32_t pairs_a_sample) {
  if (pairs_a_sample == 1) return sample_bits;
  const std::uint32_t all = (1u << pairs_a_sample) - 1;
  std::uint32_t pairs = 0;
  for (; sample_bits != 0; sample_bits &= sample_bits - 1)
    pairs |= all << (static_cast<std::uint32_t>(std::countr_zero(sample_bits)) * pairs_a_sample);
  return pairs;
}

std::uint32_t point_of_pair(std::uint32_t column, std::uint32_t line, std::uint32_t pair) {
  return kPointOfPair[line % kSquare * kSquare + column % kSquare][pair];
}

static_assert(kTile * kTile * kPairs / kLightPoints == kPointLanes,
              "a square has one vector for each point of a light");

PairVectors::PairVectors(const shape::SamplePattern& pattern, bool has_size, std::int32_t left, std::int32_t top)
    : are_rows_(!has_size) {
  const auto samples = static_cast<std::uint32_t>(pattern.count);
  vectors_ = has_size ? 1 : kTile * kTile * samples / kPointLanes;
  if (has_size) {
    lanes_.resize(kLightPoints);
    std::array<std::uint32_t, kLightPoints> count{};
    for (std::uint32_t line = 0; line < kTile; ++line)
      for (std::uint32_t column = 0; column < kTile; ++column)
        for (std::uint32_t pair = 0; pair < kPairs; ++pair) {
          const std::uint32_t point =
              point_of_pair(column + static_cast<std::uint32_t>(left), line + static_cast<std::uint32_t>(top), pair);
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
