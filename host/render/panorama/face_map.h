// Where a direction of a panorama is on the faces (host/content/film/panorama.h). Plain arithmetic, no functions of the
// C library: the same bits on all machines.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mars::panorama {

// To the right, up and ahead of the camera; of any length.
using Direction = std::array<float, 3>;

// Columns from the left and rows from the top; the middle of the first pixel is at 0.
struct FacePlace {
  std::size_t face;
  float column, row;
};

// `pixels`: of 90 degrees, without the border.
FacePlace place_of(const Direction& direction, float pixels);

// Directions on a grid of `columns` by columns / 2 over an equirectangular picture: its middle is ahead, longitude
// grows to the right from -180 to 180 degrees, latitude falls from 90 to -90.
class DirectionGrid {
 public:
  // `columns` is even.
  explicit DirectionGrid(std::uint32_t columns);

  Direction at(std::size_t column, std::size_t row) const {
    const Turn& across = longitudes_[column];
    const Turn& down = latitudes_[row];
    return {across.sine * down.cosine, down.sine, across.cosine * down.cosine};
  }

 private:
  struct Turn {
    float sine, cosine;
  };

  std::vector<Turn> longitudes_, latitudes_;
};

}  // namespace mars::panorama
