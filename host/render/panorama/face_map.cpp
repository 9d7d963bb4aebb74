#include "host/render/panorama/face_map.h"

#include <cmath>
#include <numbers>

#include "host/content/film/panorama.h"

namespace mars::panorama {
namespace {

struct Axes {
  Direction right, up, ahead;
};

constexpr Direction direction_of(const std::array<int, 3>& axis) {
  return {static_cast<float>(axis[0]), static_cast<float>(axis[1]), static_cast<float>(axis[2])};
}

constexpr std::array<Axes, film::kFaces> kAxes = [] {
  std::array<Axes, film::kFaces> all{};
  for (std::size_t face = 0; face < all.size(); ++face) {
    const film::FaceAxes& axes = film::kFaceAxes[face];
    all[face] = {direction_of(axes.right), direction_of(axes.up), direction_of(axes.ahead)};
  }
  return all;
}();

float dot(const Direction& a, const Direction& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The largest part of the direction decides; of equal ones that ahead, then that aside.
std::size_t face_of(const Direction& d) {
  const float aside = std::abs(d[0]), up = std::abs(d[1]), ahead = std::abs(d[2]);
  if (ahead >= aside && ahead >= up) return d[2] >= 0 ? 0 : 2;
  if (aside >= up) return d[0] >= 0 ? 1 : 3;
  return d[1] >= 0 ? 4 : 5;
}

// Of at most an eighth of a turn, to the last bits of a double.
double series(double x, double first, int begin) {
  constexpr int kTerms = 9;
  double sum = 0;
  for (int term = kTerms; term >= 0; --term) {
    const int power = begin + 2 * term;
    sum = 1 - x * x / ((power + 1) * (power + 2)) * sum;
  }
  return first * sum;
}
double small_sine(double x) { return series(x, x, 1); }
double small_cosine(double x) { return series(x, 1, 0); }

// Of `part` of `whole` of a turn.
double sine(std::uint64_t part, std::uint64_t whole) {
  part %= whole;
  if (2 * part > whole) return -sine(whole - part, whole);
  if (4 * part > whole) return sine(whole - 2 * part, 2 * whole);
  const double turns = static_cast<double>(part) / static_cast<double>(whole);
  if (8 * part <= whole) return small_sine(2 * std::numbers::pi * turns);
  return small_cosine(2 * std::numbers::pi * (0.25 - turns));
}

double cosine(std::uint64_t part, std::uint64_t whole) { return sine(4 * part + whole, 4 * whole); }

}  // namespace

FacePlace place_of(const Direction& direction, float pixels) {
  const std::size_t face = face_of(direction);
  const Axes& axes = kAxes[face];
  const float distance = dot(axes.ahead, direction), half = 0.5f * pixels;
  const float middle = half + (static_cast<float>(film::kFaceBorder) - 0.5f);
  return {face, middle + half * (dot(axes.right, direction) / distance),
          middle - half * (dot(axes.up, direction) / distance)};
}

DirectionGrid::DirectionGrid(std::uint32_t columns) {
  const std::uint64_t whole = 2 * std::uint64_t{columns};  // halves of a step
  const auto turn = [&](std::uint64_t halves) {
    return Turn{static_cast<float>(sine(halves, whole)), static_cast<float>(cosine(halves, whole))};
  };
  for (std::uint64_t column = 0; column < columns; ++column)
    longitudes_.push_back(turn(2 * column + 1 + whole / 2));  // from behind
  for (std::uint64_t row = 0; row < columns / 2; ++row) latitudes_.push_back(turn(whole / 4 + whole - (2 * row + 1)));
}

}  // namespace mars::panorama
