#include "node/geometry/clip.h"

#include <algorithm>
#include <cstddef>

namespace mars::geometry {
namespace {

// Inside where factor . place + offset >= 0. In double, or a cut of an edge that is long compared to near's distance
// would miss its plane by more than projection forgives.
struct Plane4 {
  double x, y, z, offset;

  double distance(const ClipVertex& v) const { return x * v.place[0] + y * v.place[1] + z * v.place[2] + offset; }
};

float between(double a, double b, double t) { return static_cast<float>(a + t * (b - a)); }

bool comes_before(const ClipVertex& a, const ClipVertex& b) {
  return std::lexicographical_compare(a.place, a.place + 3, b.place, b.place + 3);
}

ClipVertex cut(const ClipVertex& a, const ClipVertex& b, const Plane4& plane) {
  if (comes_before(b, a)) return cut(b, a, plane);
  const double from = plane.distance(a), to = plane.distance(b);
  const double t = from / (from - to);
  ClipVertex out;
  for (int axis = 0; axis < 3; ++axis) {
    out.place[axis] = between(a.place[axis], b.place[axis], t);
    out.varying[axis] = between(a.varying[axis], b.varying[axis], t);
  }
  return out;
}

void clip_by(const Plane4& plane, ClipPolygon& polygon) {
  ClipPolygon out;
  for (int i = 0; i < polygon.count; ++i) {
    const ClipVertex& here = polygon.vertex[static_cast<std::size_t>(i)];
    const ClipVertex& next = polygon.vertex[static_cast<std::size_t>((i + 1) % polygon.count)];
    const bool here_inside = plane.distance(here) >= 0, next_inside = plane.distance(next) >= 0;
    if (here_inside) out.vertex[static_cast<std::size_t>(out.count++)] = here;
    if (here_inside != next_inside) out.vertex[static_cast<std::size_t>(out.count++)] = cut(here, next, plane);
  }
  polygon = out;
}

}  // namespace

void clip(const shape::Projection& p, ClipPolygon& polygon) {
  const double at_distance = p.parallel ? 0 : -p.guard, everywhere = p.parallel ? p.guard : 0;
  const double across = double{p.scale} * p.squeeze;
  const Plane4 planes[] = {{0, 0, -1, -p.near},
                           {0, 0, 1, p.far},
                           {across, 0, at_distance, everywhere},
                           {-across, 0, at_distance, everywhere},
                           {0, p.scale, at_distance, everywhere},
                           {0, -p.scale, at_distance, everywhere}};
  for (const Plane4& plane : planes) {
    if (polygon.count == 0) return;
    clip_by(plane, polygon);
  }
}

}  // namespace mars::geometry
