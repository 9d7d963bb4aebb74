#include "node/geometry/picture_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mars::geometry {
namespace {

constexpr double kFar = std::numeric_limits<double>::max();
constexpr double kMargin = 2;                  // pixels, for snapping
constexpr double kRounding = 1.0 / (1 << 16);  // of places, relative to the largest, at most

struct Stretch {
  double low = kFar, high = -kFar;

  void add(double place) { low = std::min(low, place), high = std::max(high, place); }
};

// [first, last) of `all` lines or columns.
std::array<std::uint32_t, 2> pixels(const Stretch& stretch, double margin, double all) {
  return {static_cast<std::uint32_t>(std::clamp(stretch.low - margin, 0.0, all)),
          static_cast<std::uint32_t>(std::clamp(stretch.high + margin + 1, 0.0, all))};
}

}  // namespace

PictureBounds picture_box(const float (*points)[3], int count, const shape::Projection& projection,
                          const PictureSize& picture) {
  Stretch x, y;
  double nearest = kFar, reach = 0;
  for (int i = 0; i < count; ++i) {
    const double w = -double{points[i][2]};
    if (!(w >= projection.near)) return {{0, picture.height}, {0, picture.width}};
    const double spread = projection.parallel ? 1 : w;
    x.add(projection.center[0] - projection.origin[0] + projection.scale * projection.squeeze * points[i][0] / spread);
    y.add(projection.center[1] - projection.origin[1] - projection.scale * points[i][1] / spread);
    nearest = std::min(nearest, spread);
    for (const float along : points[i]) reach = std::max(reach, std::abs(double{along}));
  }
  const double margin = kMargin + kRounding * projection.scale * std::max(1.0f, projection.squeeze) * reach / nearest;
  const auto [top, bottom] = pixels(y, margin, picture.height);
  const auto [left, right] = pixels(x, margin, picture.width);
  if (top >= bottom || left >= right) return {};
  return {{top, bottom}, {left, right}};
}

}  // namespace mars::geometry
