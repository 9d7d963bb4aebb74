#include "tests/bench/peers/embree_sun.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace mars::bench {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kNear = 1e-3f;  // where a ray begins, in the scene's units: beyond its own triangle's rounding
constexpr int kPattern = 4;     // pixels, in each direction, whose points differ

thread_local std::uint64_t rays_traced = 0;

// Points of the unit disc at even distances, turned differently for each pixel of the pattern.
std::array<float, 2> disc_point(int point, int column, int line) {
  constexpr int kOrder[kPattern][kPattern] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
  const auto k = static_cast<float>(point);
  const float radius = std::sqrt((k + 0.5f) / kSunPoints);
  const float golden = std::numbers::pi_v<float> * (3 - std::sqrt(5.0f));
  const float turn = static_cast<float>(kOrder[line % kPattern][column % kPattern]) / (kPattern * kPattern);
  const float angle = k * golden + turn * 2 * std::numbers::pi_v<float>;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

// To points of the sun.
void set_directions(RTCRay16& rays, const View& view, const Floats (&across)[2]) {
  const auto along = [&](int axis) {
    return view.to_light[axis] + across[0] * view.across_light[0][axis] + across[1] * view.across_light[1][axis];
  };
  put(rays.dir_x, along(0));
  put(rays.dir_y, along(1));
  put(rays.dir_z, along(2));
  put(rays.tfar, Floats{} + kFar);
}

}  // namespace

Sun::Sun(float size, const Lanes& lanes)
    : width_(lanes.width), height_(lanes.height), rays_(size == 0 ? 1 : std::max(1, kSunPoints / lanes.samples)) {
  const int samples = kPacket / rays_;  // of a bundle
  for (int first = 0; first < kPacket; first += samples) {
    Bundle& bundle = bundles_.emplace_back();
    for (int k = 0; k < kPacket; ++k) bundle.lane[k] = first + k % samples, bundle.ray[k] = k / samples;
  }
  for (int top = 0; top < kPattern; top += height_)
    for (int left = 0; left < kPattern; left += width_)
      for (const Bundle& bundle : bundles_) {
        Offsets& offsets = offsets_.emplace_back();
        for (int k = 0; k < kPacket; ++k) {
          const int lane = bundle.lane[k], point = bundle.ray[k] * lanes.samples + lanes.sample[lane];
          const auto at = disc_point(point, left + lanes.column[lane], top + lanes.line[lane]);
          for (std::size_t c = 0; c < 2; ++c) offsets.across[c][k] = size * at[c];
        }
      }
}

Ints Sun::open(const Spots& spots, Ints tried, std::initializer_list<const View*> blockers) const {
  if (!traces || !any(tried != 0)) return tried;
  for (int k = 0; k < rays_; ++k) rays_traced += static_cast<unsigned>(std::popcount(mask_of((tried & 1 << k) != 0)));
  const int block = spots.top % kPattern / height_ * (kPattern / width_) + spots.left % kPattern / width_;
  Ints open = tried;
  for (const View* view : blockers)
    if (!view->empty()) trace(*view, spots, &offsets_[static_cast<std::size_t>(block) * bundles_.size()], open);
  return open;
}

// Takes from `open` those that the view stops.
void Sun::trace(const View& view, const Spots& spots, const Offsets* offsets, Ints& open) const {
  const Directions directions = directions_of(view, spots.x, spots.y);
  Floats from[3];
  for (int axis = 0; axis < 3; ++axis) from[axis] = view.origin[axis] + spots.z * directions.axis[axis];
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRay16 rays;
  put(rays.tnear, Floats{} + kNear);
  put(rays.time, Floats{});
  put(rays.mask, Ints{} - 1);
  for (const Bundle& bundle : bundles_) {
    const Offsets& own = *offsets++;
    const Ints tracing = (__builtin_shuffle(open, bundle.lane) >> bundle.ray & 1) != 0;
    if (!any(tracing)) continue;
    put(rays.org_x, __builtin_shuffle(from[0], bundle.lane));
    put(rays.org_y, __builtin_shuffle(from[1], bundle.lane));
    put(rays.org_z, __builtin_shuffle(from[2], bundle.lane));
    set_directions(rays, view, own.across);
    rtcOccluded16(reinterpret_cast<const int*>(&tracing), view.scene, &context, &rays);
    const Ints stopped = tracing & (got<Floats>(rays.tfar) < 0);
    for (unsigned left = mask_of(stopped); left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      open[bundle.lane[k]] &= ~(1 << bundle.ray[k]);
    }
  }
}

Floats Sun::share(Ints open) const {
  Ints count{};
  for (int k = 0; k < rays_; ++k) count += open >> k & 1;
  return __builtin_convertvector(count, Floats) / static_cast<float>(rays_);
}

std::uint64_t take_rays_traced() { return std::exchange(rays_traced, 0); }

}  // namespace mars::bench
