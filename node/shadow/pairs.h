// The pairs of a pixel: its samples times points of a light. A light without size has one point, and a pixel as many
// pairs as samples. One with size has kLightPoints, of which each pixel uses 16 / samples for each sample, others than
// its neighbours in a square of 4 x 4 pixels, so that such a square uses each point equally often. A pixel's pairs are
// bits: sample s has bits [s n, (s + 1) n), n = pairs_a_sample.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "node/shadow/point_vector.h"
#include "node/shape/sample_pattern.h"

namespace mars::shadow {

inline constexpr std::uint32_t kPairs = 16;  // of a pixel, for a light that has a size

constexpr std::uint32_t pairs_a_sample(std::uint32_t samples, bool has_size) { return has_size ? kPairs / samples : 1; }

// The pairs of some samples, one bit each.
std::uint32_t pairs_of(std::uint32_t sample_bits, std::uint32_t pairs_a_sample);

// The point that a pair of the pixel at (column, line) of the whole picture uses, of a light with size. Columns and
// lines below 0 are as they are modulo 2^32.
std::uint32_t point_of_pair(std::uint32_t column, std::uint32_t line, std::uint32_t pair);

// Where the points of a vector lie in a square of kTile x kTile pixels.
inline constexpr std::uint32_t kTile = 8;
inline constexpr std::uint32_t kSquare = 4;
struct Lane {
  std::uint8_t column, line, sample, pair;

  // Of kSquare x kSquare pixels, row by row.
  std::uint32_t square() const { return line / kSquare * (kTile / kSquare) + column / kSquare; }
};
// A square of the picture by number, and some of its squares of kSquare x kSquare pixels (Lane::square).
struct TilePart {
  static constexpr std::uint32_t kAll = 0xf;

  std::uint32_t tile;
  std::uint32_t squares;
};

struct VectorLanes {
  std::array<Lane, kPointLanes> lane;
  LanePlaces place;
};

// The vectors of a square, which has points of all its pixels' pairs with one point of a light.
class PairVectors {
 public:
  // `left`, `top`: of the part of the picture that is drawn (shape::Projection::origin).
  PairVectors(const shape::SamplePattern& pattern, bool has_size, std::int32_t left = 0, std::int32_t top = 0);

  std::uint32_t vectors() const { return vectors_; }
  // Whether each four lanes are of neighbouring pixels of a line.
  bool are_rows() const { return are_rows_; }
  const VectorLanes& lanes(std::uint32_t light_point, std::uint32_t vector) const {
    return lanes_[light_point * vectors_ + vector];
  }

 private:
  static Lane lane_of(std::uint32_t column, std::uint32_t line, std::uint32_t sample, std::uint32_t pair);
  void place(const shape::SamplePattern& pattern);

  bool are_rows_;
  std::uint32_t vectors_;  // of a square, for one point of the light
  std::vector<VectorLanes> lanes_;
};

}  // namespace mars::shadow
