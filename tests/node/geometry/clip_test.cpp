// Clipping: what is left lies inside, is all that lies inside, and neighbours are cut at the same places.
#include "node/geometry/clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <vector>

#include "tests/node/shape/patches.h"

namespace mars::geometry {
namespace {

using shape::Projection;

ClipVertex vertex(shape::Random& random, double size) {
  ClipVertex out{};
  for (float& p : out.place) p = static_cast<float>(random.real(-size, size));
  for (float& n : out.varying) n = static_cast<float>(random.real(-1, 1));
  return out;
}

ClipPolygon triangle(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c) {
  ClipPolygon polygon;
  polygon.vertex[0] = a;
  polygon.vertex[1] = b;
  polygon.vertex[2] = c;
  polygon.count = 3;
  return polygon;
}

// A guard band narrow enough for random triangles to cross it.
Projection narrow(double near, double far) {
  Projection view = shape::projection(640, 480, 2, near, far);
  view.guard = 1000;
  return view;
}

using Exact = std::array<long double, 3>;

// Signed distances from the six planes, all at least 0 inside.
std::array<long double, 6> distances(const Projection& p, const Exact& at) {
  const long double w = -at[2], x = p.scale * at[0], y = p.scale * at[1], band = p.guard * w;
  return {w - p.near, p.far - w, band + x, band - x, band + y, band - y};
}

std::vector<Exact> clip_exactly(const Projection& view, const ClipPolygon& polygon) {
  std::vector<Exact> points;
  for (int k = 0; k < polygon.count; ++k) {
    const float* p = polygon.vertex[static_cast<std::size_t>(k)].place;
    points.push_back({p[0], p[1], p[2]});
  }
  for (std::size_t plane = 0; plane < 6; ++plane) {
    std::vector<Exact> inside;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Exact &a = points[k], &b = points[(k + 1) % points.size()];
      const long double from = distances(view, a)[plane], to = distances(view, b)[plane];
      if (from >= 0) inside.push_back(a);
      if ((from >= 0) == (to >= 0)) continue;
      const long double t = from / (from - to);
      inside.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
    }
    points = inside;
  }
  return points;
}

std::vector<Exact> points_of(const ClipPolygon& polygon) {
  std::vector<Exact> points;
  for (int k = 0; k < polygon.count; ++k) {
    const float* p = polygon.vertex[static_cast<std::size_t>(k)].place;
    points.push_back({p[0], p[1], p[2]});
  }
  return points;
}

// Of a flat polygon in space.
double area(const std::vector<Exact>& points) {
  shape::Vec3 sum{};
  for (std::size_t k = 2; k < points.size(); ++k) {
    shape::Vec3 a, b;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      a[axis] = static_cast<double>(points[k - 1][axis] - points[0][axis]);
      b[axis] = static_cast<double>(points[k][axis] - points[0][axis]);
    }
    const shape::Vec3 one = shape::cross(a, b);
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += one[axis] / 2;
  }
  return shape::length(sum);
}

// Near and far lie as far apart as they do in films; slack is relative to the planes' own distances.
void expect_inside(const Projection& view, const ClipPolygon& polygon) {
  for (const Exact& point : points_of(polygon)) {
    const auto d = distances(view, point);
    const auto w = static_cast<double>(-point[2]);
    EXPECT_GE(static_cast<double>(d[0]), -1e-3 * view.near);
    EXPECT_GE(static_cast<double>(d[1]), -1e-3 * view.far);
    for (std::size_t plane = 2; plane < 6; ++plane) EXPECT_GE(static_cast<double>(d[plane]), -1e-3 * view.guard * w);
  }
}

TEST(Clip, KeepsExactlyWhatIsInside) {
  shape::Random random(30);
  int cut = 0, gone = 0;
  for (int trial = 0; trial < 50000; ++trial) {
    const Projection view = narrow(0.5, 6);
    const double size = trial % 2 ? 3 : 10;
    ClipPolygon polygon = triangle(vertex(random, size), vertex(random, size), vertex(random, size));
    const double expected = area(clip_exactly(view, polygon));
    clip(view, polygon);
    ASSERT_NEAR(area(points_of(polygon)), expected, 1e-5 * size * size);
    expect_inside(view, polygon);
    gone += polygon.count == 0;
    cut += polygon.count > 3;
  }
  EXPECT_GT(cut, 5000);
  EXPECT_GT(gone, 5000);
}

// Triangles that reach from far behind the eye to the horizon, as a plane one walks on does.
TEST(Clip, LargeTrianglesNearTheEye) {
  shape::Random random(31);
  const Projection view = shape::projection(640, 480, 2, 0.05, 1e6);
  for (int trial = 0; trial < 5000; ++trial) {
    const double size = std::pow(10, random.real(1, 6));
    ClipPolygon polygon = triangle(vertex(random, size), vertex(random, size), vertex(random, size));
    for (int k = 0; k < 3; ++k) polygon.vertex[static_cast<std::size_t>(k)].place[1] = -1;
    clip(view, polygon);
    expect_inside(view, polygon);
    ASSERT_FALSE(HasFailure()) << "size " << size;
  }
}

TEST(Clip, LeavesWhatIsInsideAlone) {
  shape::Random random(32);
  const Projection view = narrow(0.5, 100);
  for (int trial = 0; trial < 1000; ++trial) {
    ClipVertex v[3];
    for (ClipVertex& one : v) {
      one = vertex(random, 1);
      one.place[2] -= 5;
    }
    ClipPolygon polygon = triangle(v[0], v[1], v[2]);
    clip(view, polygon);
    ASSERT_EQ(polygon.count, 3);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(std::memcmp(&polygon.vertex[k], &v[k], sizeof v[k]), 0);
  }
}

// Normals and places are cut in the same proportion.
TEST(Clip, CutsNormalsWithPlaces) {
  shape::Random random(33);
  const Projection view = narrow(0.5, 6);
  for (int trial = 0; trial < 2000; ++trial) {
    ClipVertex v[3];
    for (ClipVertex& one : v) {
      one = vertex(random, 5);
      for (int axis = 0; axis < 3; ++axis) one.varying[axis] = one.place[axis] / 5 + 1;
    }
    ClipPolygon polygon = triangle(v[0], v[1], v[2]);
    clip(view, polygon);
    for (int k = 0; k < polygon.count; ++k) {
      const ClipVertex& one = polygon.vertex[static_cast<std::size_t>(k)];
      for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(one.varying[axis], one.place[axis] / 5 + 1, 1e-5);
    }
  }
}

// A corner that says by its normal how much it has of the triangle's first, second and third.
ClipVertex marked(shape::Random& random, float deep, std::size_t number) {
  ClipVertex out = vertex(random, 8);
  out.place[2] *= deep;
  for (std::size_t axis = 0; axis < 3; ++axis) out.varying[axis] = axis == number ? 1 : 0;
  return out;
}

// Corners of `polygon` on the edge from the first to the second, other than these.
std::vector<std::array<float, 6>> cuts(const ClipPolygon& polygon) {
  std::vector<std::array<float, 6>> found;
  for (int k = 0; k < polygon.count; ++k) {
    const auto& [place, normal] = polygon.vertex[static_cast<std::size_t>(k)];
    if (normal[2] != 0 || normal[0] == 1 || normal[1] == 1) continue;
    found.push_back({place[0], place[1], place[2], normal[0], normal[1], normal[2]});
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Clip, NeighboursAreCutAtTheSamePlaces) {
  shape::Random random(34);
  const Projection view = narrow(0.5, 6);
  std::size_t seen = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const float deep = trial % 4 ? 1 : 1e8f;  // on long edges rounding shows in which direction they were cut
    const ClipVertex a = marked(random, deep, 0), b = marked(random, deep, 1);
    ClipPolygon one = triangle(a, b, marked(random, deep, 2)), other = triangle(b, a, marked(random, deep, 2));
    if (trial % 2) std::rotate(other.vertex.begin(), other.vertex.begin() + 1, other.vertex.begin() + 3);
    clip(view, one);
    clip(view, other);
    ASSERT_EQ(cuts(one), cuts(other)) << "trial " << trial;
    seen += cuts(one).size();
  }
  EXPECT_GT(seen, 5000u);
}

TEST(Clip, NothingIsLeftOfWhatIsOutside) {
  shape::Random random(35);
  const Projection view = narrow(0.5, 20);
  for (int trial = 0; trial < 1000; ++trial) {
    for (const shape::Vec3& middle : {shape::Vec3{0, 0, 2}, shape::Vec3{0, 0, -23}, shape::Vec3{-15, 0, -5},
                                      shape::Vec3{15, 0, -5}, shape::Vec3{0, 15, -5}}) {
      ClipPolygon polygon = triangle(vertex(random, 1), vertex(random, 1), vertex(random, 1));
      for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis)
          polygon.vertex[static_cast<std::size_t>(k)].place[axis] +=
              static_cast<float>(middle[static_cast<std::size_t>(axis)]);
      clip(view, polygon);
      EXPECT_EQ(polygon.count, 0);
    }
  }
}

// Places on the planes themselves, infinite and not a number, in any mixture.
TEST(Clip, BadNumbersDoNoHarm) {
  shape::Random random(36);
  const Projection view = narrow(0.5, 6);
  const float ratio = view.guard / view.scale;
  const float odd[] = {0,
                       -0.0f,
                       0.5f,
                       -0.5f,
                       -6,
                       6,
                       -0.5f * ratio,
                       6 * ratio,
                       1e38f,
                       -1e38f,
                       1e-40f,
                       std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity(),
                       std::numeric_limits<float>::quiet_NaN()};
  const auto pick = [&] { return odd[random.whole(0, static_cast<std::int32_t>(std::size(odd)) - 1)]; };
  for (int trial = 0; trial < 200000; ++trial) {
    ClipPolygon polygon = triangle(vertex(random, 8), vertex(random, 8), vertex(random, 8));
    for (std::size_t k = 0; k < 3; ++k)
      for (float& p : polygon.vertex[k].place)
        if (random.whole(0, 3)) p = pick();
    clip(view, polygon);
    ASSERT_GE(polygon.count, 0);
    ASSERT_LE(polygon.count, 9);
  }
}

}  // namespace
}  // namespace mars::geometry
