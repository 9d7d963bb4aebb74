#include "tests/node/raster/plain_set_up.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "node/geometry/clip.h"

namespace mars::raster {
namespace {

using shape::kValues;
using shape::Projection;

struct PlainVertex {
  geometry::ClipVertex eye;
  bool outside = true;
  std::int32_t x = 0, y = 0;
  float values[kValues] = {};
};

PlainVertex project(const Projection& p, const geometry::ClipVertex& eye) {
  PlainVertex out{eye};
  const float w = -eye.place[2], inverse = p.parallel ? 1.0f : 1.0f / w;
  const float dx = p.scale * (eye.place[0] * inverse), dy = -p.scale * (eye.place[1] * inverse);
  out.outside = !(w >= p.near && w <= p.far && std::abs(dx) <= p.guard && std::abs(dy) <= p.guard);
  if (out.outside) return out;
  out.x = static_cast<std::int32_t>(std::floor((p.center[0] + dx) * 256.0f + 0.5f));
  out.y = static_cast<std::int32_t>(std::floor((p.center[1] + dy) * 256.0f + 0.5f));
  out.values[shape::kDepth] = p.parallel ? -w : inverse;
  for (int axis = 0; axis < 3; ++axis) out.values[shape::kNormalX + axis] = eye.varying[axis] * inverse;
  return out;
}

PlainVertex vertex(const shape::Surface& surface, const Projection& projection, std::uint32_t number) {
  const shape::Vertices& v = surface.vertices();
  geometry::ClipVertex eye;
  for (int axis = 0; axis < 3; ++axis) {
    eye.place[axis] = v.place[axis][number];
    eye.varying[axis] = v.normal[axis][number];
  }
  return project(projection, eye);
}

float sum_of_sizes(const float* a) { return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]); }

// Whether the eye is on the outer side of the triangle in space, or by its normals where it is all but a line.
bool faces_eye(const Projection& p, const PlainVertex (&t)[3]) {
  const float* a = t[0].eye.place;
  float b[3], c[3];
  for (int axis = 0; axis < 3; ++axis) {
    b[axis] = t[1].eye.place[axis] - a[axis];
    c[axis] = t[2].eye.place[axis] - a[axis];
  }
  const float volume =
      a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  const float away = sum_of_sizes(a), sides = sum_of_sizes(b) + sum_of_sizes(c);
  const float toward_eye = p.parallel ? b[0] * c[1] - b[1] * c[0] : -volume;
  if (std::abs(toward_eye) > 1e-6f * away * (p.parallel ? 1.0f : away) * sides) return toward_eye > 0;
  float toward = 0;
  for (const PlainVertex& corner : t)
    for (int axis = 0; axis < 3; ++axis) {
      const float from_eye = !p.parallel ? corner.eye.place[axis] : axis == 2 ? -1.0f : 0.0f;
      toward -= corner.eye.varying[axis] * from_eye;
    }
  return toward > 0;
}

// As large as four 1/256 pixel times the lengths of two sides.
bool larger_than_snapping(const Corners& t) {
  std::int64_t lengths = 0;
  for (int k = 1; k < 3; ++k) lengths += std::abs(t.x[k] - t.x[0]) + std::abs(t.y[k] - t.y[0]);
  return std::abs(area(t)) > 4 * lengths;
}

void set_planes(const PlainVertex (&t)[3], PlainTriangle& out) {
  const Corners& at = out.corners;
  const auto x1 = static_cast<float>(at.x[1] - at.x[0]), y1 = static_cast<float>(at.y[1] - at.y[0]);
  const auto x2 = static_cast<float>(at.x[2] - at.x[0]), y2 = static_cast<float>(at.y[2] - at.y[0]);
  const float inverse = 1.0f / static_cast<float>(area(at));
  for (int value = 0; value < kValues; ++value) {
    const float sign = value == shape::kDepth || out.faces ? 1.0f : -1.0f;
    const float f0 = sign * t[0].values[value];
    const float d1 = sign * t[1].values[value] - f0, d2 = sign * t[2].values[value] - f0;
    out.record.at_first[value] = f0;
    out.record.per_x[value] = (d1 * y2 - d2 * y1) * inverse;
    out.record.per_y[value] = (d2 * x1 - d1 * x2) * inverse;
  }
}

void set_depth_exactly(const PlainVertex (&t)[3], PlainTriangle& out) {
  const Corners& at = out.corners;
  const double first = t[0].values[shape::kDepth];
  const double d1 = t[1].values[shape::kDepth] - first, d2 = t[2].values[shape::kDepth] - first;
  const double x1 = at.x[1] - at.x[0], y1 = at.y[1] - at.y[0], x2 = at.x[2] - at.x[0], y2 = at.y[2] - at.y[0];
  const auto whole = static_cast<double>(area(at));
  out.record.per_x[shape::kDepth] = static_cast<float>((d1 * y2 - d2 * y1) / whole);
  out.record.per_y[shape::kDepth] = static_cast<float>((d2 * x1 - d1 * x2) / whole);
}

void add(const Projection& p, const PlainVertex (&t)[3], const PlainVertex (&whole)[3], std::optional<bool> known,
         const PatchIdentity& identity, std::uint32_t index, std::vector<PlainTriangle>& out) {
  PlainTriangle made{};
  made.corners = {{t[0].x, t[1].x, t[2].x}, {t[0].y, t[1].y, t[2].y}};
  if (area(made.corners) == 0) return;
  made.faces = known ? *known : larger_than_snapping(made.corners) ? area(made.corners) < 0 : faces_eye(p, t);
  if (identity.one_sided && made.faces == identity.mirrored) return;
  set_planes(t, made);
  made.record.first_x = t[0].x;
  made.record.first_y = t[0].y;
  made.record.patch = identity.patch;
  made.record.material = identity.material;
  made.index = index;
  for (int k = 0; k < 3; ++k) {
    made.eye[k] = t[k].eye;
    made.whole[k] = whole[k].eye;
  }
  out.push_back(made);
}

// A fan of what is left; what clipping cut lies on its planes but for rounding.
void add_clipped(const PlainVertex (&t)[3], const Projection& projection, const PatchIdentity& identity,
                 std::uint32_t index, bool casting, std::vector<PlainTriangle>& out) {
  geometry::ClipPolygon polygon;
  for (const PlainVertex& corner : t) polygon.vertex[static_cast<std::size_t>(polygon.count++)] = corner.eye;
  geometry::clip(projection, polygon);
  Projection wider = projection;
  wider.near /= 1.001f;
  wider.far *= 1.001f;
  wider.guard *= 1.001f;
  const auto corner = [&](int k) { return project(wider, polygon.vertex[static_cast<std::size_t>(k)]); };
  for (int k = 1; k + 1 < polygon.count; ++k) {
    const PlainVertex piece[3] = {corner(0), corner(k), corner(k + 1)};
    if (piece[0].outside || piece[1].outside || piece[2].outside) continue;
    const std::size_t before = out.size();
    add(projection, piece, t, faces_eye(projection, t), identity, index, out);
    if (casting && out.size() > before) set_depth_exactly(piece, out.back());
  }
}

}  // namespace

std::vector<PlainTriangle> plain_set_up(const shape::Surface& surface, const Projection& projection,
                                        const PatchIdentity& identity, bool casting) {
  std::vector<PlainTriangle> out;
  for (std::uint32_t k = 0; k < surface.triangles().count; ++k) {
    const shape::Corner3 corners = surface.triangles()[k];
    const PlainVertex t[3] = {vertex(surface, projection, corners.a), vertex(surface, projection, corners.b),
                              vertex(surface, projection, corners.c)};
    if (t[0].outside || t[1].outside || t[2].outside)
      add_clipped(t, projection, identity, k, casting, out);
    else
      add(projection, t, t, std::nullopt, identity, k, out);
  }
  return out;
}

std::int64_t area(const Corners& t) {
  return std::int64_t{t.x[1] - t.x[0]} * (t.y[2] - t.y[0]) - std::int64_t{t.x[2] - t.x[0]} * (t.y[1] - t.y[0]);
}

// With positive area and y downwards left sides go up, top ones to the right.
bool covers_place(const Corners& t, std::int64_t x, std::int64_t y) {
  const std::int64_t twice = area(t);
  if (twice == 0) return false;
  const int order[] = {0, twice > 0 ? 1 : 2, twice > 0 ? 2 : 1, 0};
  for (int k = 0; k < 3; ++k) {
    const std::int64_t ax = t.x[order[k]], ay = t.y[order[k]], bx = t.x[order[k + 1]], by = t.y[order[k + 1]];
    const std::int64_t side = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
    const bool owned = by < ay || (by == ay && bx > ax);
    if (side < 0 || (side == 0 && !owned)) return false;
  }
  return true;
}

bool covers(const Corners& t, std::int32_t column, std::int32_t row, const shape::SamplePattern& pattern) {
  const std::int32_t line = row / pattern.count, sample = row % pattern.count;
  return covers_place(t, 256 * std::int64_t{column} + pattern.x[sample], 256 * std::int64_t{line} + pattern.y[sample]);
}

std::vector<UnsortedEdgeBox> plain_edge_boxes(const Corners& t, std::int32_t width, std::int32_t height,
                                              const shape::SamplePattern& pattern) {
  const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
  const std::int32_t first = std::max(left / 256 - 1, 0), last = std::min(right / 256 + 1, width);
  const std::int32_t first_line = std::max(top / 256 - 1, 0), last_line = std::min(bottom / 256 + 1, height);
  std::vector<UnsortedEdgeBox> out;
  for (std::int32_t row = first_line * pattern.count; row < last_line * pattern.count; ++row) {
    std::int32_t begin = first;
    while (begin < last && !covers(t, begin, row, pattern)) ++begin;
    if (begin >= last) continue;
    std::int32_t end = begin;
    while (end < last && covers(t, end, row, pattern)) ++end;
    out.push_back({{0, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin - 1),
                    static_cast<std::uint32_t>(row % pattern.count)},
                   static_cast<std::uint16_t>(row / pattern.count),
                   0});
  }
  return out;
}

}  // namespace mars::raster
