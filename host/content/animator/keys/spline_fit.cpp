#include "host/content/animator/keys/spline_fit.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "host/content/animator/pose/channel.h"

namespace mars::animator {
namespace {

using Keys = Channel<glm::dvec3>;

constexpr double kFinerSlopes = 0.01;  // grain of slopes, of that of values
constexpr double kPull = 1e-3;         // of least squares towards the curve's own slopes, so that few frames suffice

glm::dvec3 grained(const glm::dvec3& value, double grain) {
  const double parts = std::round(1 / grain);  // decimal digits stay short
  return parts >= 1 ? glm::round(value * parts) / parts : glm::round(value / grain) * grain;
}

// A cubic from one frame of a curve to another.
struct Cubic {
  glm::dvec3 leave, reach;  // slopes
};

class CurveFit {
 public:
  explicit CurveFit(const DenseCurve& curve) : curve_(curve) {}

  std::optional<Cubic> cubic(std::size_t from, std::size_t to) const {
    const Cubic smooth{slope(from), slope(to)};
    if (to == from + 1) return smooth;  // no frame lies between
    if (holds(from, to, smooth)) return smooth;
    const Cubic nearest = least_squares(from, to, smooth);
    if (holds(from, to, nearest)) return nearest;
    return std::nullopt;
  }

  // Keys on some of `frames`, among them the first and the last.
  std::vector<FittedKey> keys_on(std::span<const std::size_t> frames) const {
    Keys keys = {key_at(frames.front())};
    for (std::size_t from = 0; from + 1 < frames.size();) {
      std::size_t to = from + 1;
      Cubic found = cubic(frames[from], frames[to]).value();
      for (std::size_t next = to + 1; next < frames.size(); ++next) {
        const std::optional<Cubic> longer = cubic(frames[from], frames[next]);
        if (!longer) break;
        to = next;
        found = *longer;
      }
      keys.back().out = grained_slope(found.leave);
      keys.push_back(key_at(frames[to]));
      keys.back().in = grained_slope(found.reach);
      from = to;
    }
    simplify(keys);
    std::vector<FittedKey> fitted;
    for (const Key<glm::dvec3>& key : keys) fitted.push_back({key.frame, key.value, key.in, key.out});
    return fitted;
  }

 private:
  glm::dvec3 grained_slope(const glm::dvec3& slope) const { return grained(slope, curve_.grain * kFinerSlopes); }

  Key<glm::dvec3> key_at(std::size_t frame) const {
    return {static_cast<std::uint32_t>(frame), grained(curve_.values[frame], curve_.grain), kSpline};
  }

  // The curve's own.
  glm::dvec3 slope(std::size_t frame) const {
    const std::size_t before = frame == 0 ? 0 : frame - 1, after = std::min(frame + 1, curve_.values.size() - 1);
    return (curve_.values[after] - curve_.values[before]) / double(after - before);
  }

  bool holds(std::size_t from, std::size_t to, const Cubic& way) const {
    Keys keys = {key_at(from), key_at(to)};
    keys[0].out = grained_slope(way.leave);
    keys[1].in = grained_slope(way.reach);
    return holds(keys, 0);
  }

  // Whether the way from this key to the next is everywhere near enough.
  bool holds(const Keys& keys, std::size_t key) const {
    const double frames = double(keys[key + 1].frame - keys[key].frame);
    for (std::uint32_t frame = keys[key].frame + 1; frame < keys[key + 1].frame; ++frame)
      if (!(curve_.error(frame, spline_at(keys, {key, key + 1, (frame - keys[key].frame) / frames})) <= 1))
        return false;
    return true;
  }

  // The slopes with which the cubic is nearest to the curve, of an axis like of the others.
  Cubic least_squares(std::size_t from, std::size_t to, const Cubic& near) const {
    const double frames = double(to - from);
    const glm::dvec3 first = curve_.values[from], last = curve_.values[to];
    double aa = 0, ab = 0, bb = 0;
    glm::dvec3 ar(0), br(0);
    for (std::size_t frame = from + 1; frame < to; ++frame) {
      const double t = double(frame - from) / frames;
      const double a = ((t - 2) * t + 1) * t * frames, b = (t - 1) * t * t * frames;
      const glm::dvec3 rest = curve_.values[frame] - first - ((3 - 2 * t) * t * t) * (last - first);
      aa += a * a, ab += a * b, bb += b * b;
      ar += a * rest, br += b * rest;
    }
    const double pull = kPull * (aa + bb) + 1e-12;
    aa += pull, bb += pull;
    ar += pull * near.leave, br += pull * near.reach;
    const double det = aa * bb - ab * ab;
    return {(bb * ar - ab * br) / det, (aa * br - ab * ar) / det};
  }

  // One slope at a key instead of two, or none, where that is near enough. The ends keep theirs: what is beyond them
  // is not known here.
  void simplify(Keys& keys) const {
    for (std::size_t i = 1; i + 1 < keys.size(); ++i) {
      const Key<glm::dvec3> was = keys[i];
      const glm::dvec3 both = grained_slope((*was.in + *was.out) / 2.0);
      const std::optional<glm::dvec3> simpler[] = {std::nullopt, both};
      for (const auto& slope : simpler) {
        keys[i].in = keys[i].out = slope;
        if (holds(keys, i - 1) && holds(keys, i)) break;
        keys[i] = was;
      }
    }
  }

  const DenseCurve& curve_;
};

// The farthest frame to which every curve has a way: tried twice as far each time, then by halves.
std::size_t farthest_from(std::size_t from, std::size_t last, std::span<const CurveFit> fits) {
  const auto good = [&](std::size_t to) {
    return std::ranges::all_of(fits, [&](const CurveFit& fit) { return fit.cubic(from, to).has_value(); });
  };
  std::size_t reached = from + 1, bound = last + 1;
  for (std::size_t step = 2; from + step < bound; step *= 2) (good(from + step) ? reached : bound) = from + step;
  while (bound - reached > 1) {
    const std::size_t middle = (reached + bound) / 2;
    (good(middle) ? reached : bound) = middle;
  }
  return reached;
}

}  // namespace

std::vector<std::vector<FittedKey>> fit_splines(std::span<const DenseCurve> curves) {
  const std::vector<CurveFit> fits(curves.begin(), curves.end());
  const std::size_t last = curves.front().values.size() - 1;
  std::vector<std::size_t> frames = {0};
  while (frames.back() < last) frames.push_back(farthest_from(frames.back(), last, fits));
  std::vector<std::vector<FittedKey>> keys;
  for (const CurveFit& fit : fits) keys.push_back(fit.keys_on(frames));
  return keys;
}

}  // namespace mars::animator
