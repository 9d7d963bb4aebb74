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

void set_origin(RTCRay16& ray, const View& view, const Spots& at) {
  const Directions directions = directions_of(view, at.x, at.y);
  put(ray.org_x, view.origin[0] + at.z * directions.axis[0]);
  put(ray.org_y, view.origin[1] + at.z * directions.axis[1]);
  put(ray.org_z, view.origin[2] + at.z * directions.axis[2]);
  put(ray.tnear, Floats{} + kNear);
  put(ray.time, Floats{});
  put(ray.mask, Ints{} - 1);
}

void set_direction(RTCRay16& ray, const View& view, const Floats (&across)[2]) {
  const auto along = [&](int axis) {
    return view.to_light[axis] + across[0] * view.across_light[0][axis] + across[1] * view.across_light[1][axis];
  };
  put(ray.dir_x, along(0));
  put(ray.dir_y, along(1));
  put(ray.dir_z, along(2));
  put(ray.tfar, Floats{} + kFar);
}

}  // namespace

Sun::Sun(float size, const Lanes& lanes)
    : width_(lanes.width), height_(lanes.height), rays_(size == 0 ? 1 : std::max(1, kSunPoints / lanes.samples)) {
  for (int top = 0; top < kPattern; top += height_)
    for (int left = 0; left < kPattern; left += width_)
      for (int ray = 0; ray < rays_; ++ray) {
        Offsets& offsets = offsets_.emplace_back();
        for (int k = 0; k < kPacket; ++k) {
          const auto at =
              disc_point(ray * lanes.samples + lanes.sample[k], left + lanes.column[k], top + lanes.line[k]);
          for (std::size_t c = 0; c < 2; ++c) offsets.across[c][k] = size * at[c];
        }
      }
}

Ints Sun::open(const Spots& spots, Ints tried, std::initializer_list<const View*> blockers) const {
  if (!traces || !any(tried != 0)) return tried;
  const int block = spots.top % kPattern / height_ * (kPattern / width_) + spots.left % kPattern / width_;
  const Offsets* offsets = &offsets_[static_cast<std::size_t>(block * rays_)];
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (int k = 0; k < rays_; ++k) rays_traced += static_cast<unsigned>(std::popcount(mask_of((tried & 1 << k) != 0)));
  Ints open = tried;
  for (const View* view : blockers) {
    if (view->empty()) continue;
    RTCRay16 rays;
    set_origin(rays, *view, spots);
    for (int k = 0; k < rays_; ++k) {
      const Ints tracing = (open & 1 << k) != 0;
      if (!any(tracing)) continue;
      set_direction(rays, *view, offsets[k].across);
      rtcOccluded16(reinterpret_cast<const int*>(&tracing), view->scene, &context, &rays);
      open &= ~(tracing & (got<Floats>(rays.tfar) < 0) & 1 << k);
    }
  }
  return open;
}

Floats Sun::share(Ints open) const {
  Ints count{};
  for (int k = 0; k < rays_; ++k) count += open >> k & 1;
  return __builtin_convertvector(count, Floats) / static_cast<float>(rays_);
}

std::uint64_t take_rays_traced() { return std::exchange(rays_traced, 0); }

}  // namespace mars::bench
