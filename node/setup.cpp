#include "node/setup.h"

#include <cmath>

#include "node/clip.h"

namespace mars::node {
namespace {

// Cut vertices lie on the planes but for rounding: they pass a projection this much wider.
constexpr float kSlack = 1.001f;

// Triangles no higher than this many 1/256 pixel may have been turned over by snapping.
constexpr std::int64_t kThin = 4;

// The plane through values f0, f1, f2 at the triangle's vertices.
class PlaneMaker {
 public:
  PlaneMaker(const Triangle& t, float determinant)
      : x1_(static_cast<float>(t.x[1] - t.x[0])),
        x2_(static_cast<float>(t.x[2] - t.x[0])),
        y1_(static_cast<float>(t.y[1] - t.y[0])),
        y2_(static_cast<float>(t.y[2] - t.y[0])),
        inverse_(1.0f / determinant) {}

  Plane operator()(float f0, float f1, float f2) const {
    const float d1 = f1 - f0, d2 = f2 - f0;
    return {f0, (d1 * y2_ - d2 * y1_) * inverse_, (d2 * x1_ - d1 * x2_) * inverse_};
  }

 private:
  float x1_, x2_, y1_, y2_, inverse_;
};

// Twice the area in 1/65536 square pixel; y grows downwards, so negative where counter-clockwise to the eye.
std::int64_t determinant(const Triangle& t) {
  const std::int64_t x1 = t.x[1] - t.x[0], x2 = t.x[2] - t.x[0];
  const std::int64_t y1 = t.y[1] - t.y[0], y2 = t.y[2] - t.y[0];
  return x1 * y2 - x2 * y1;
}

float sum_of_sizes(const float* a) { return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]); }

// Whether the surface's outside by the vertices' normals is turned to the eye, on average.
bool normals_face_eye(const Vertices& v, const Corner3& corners) {
  float toward = 0;
  for (const std::uint32_t corner : {corners.a, corners.b, corners.c})
    for (int axis = 0; axis < 3; ++axis) toward -= v.normal[axis][corner] * v.place[axis][corner];
  return toward > 0;
}

// Whether the eye is on the side of the triangle to which (b - a) x (c - a) points. Asked of the places before
// snapping, which can turn a thin triangle over; where even these are in a line but for rounding (beside the
// tip of a cone), the normals tell. Else such a triangle would be lit from behind.
bool faces_eye(const Vertices& v, const Corner3& corners) {
  constexpr float kRounding = 1e-6f;
  float a[3], b[3], c[3];
  for (int axis = 0; axis < 3; ++axis) {
    a[axis] = v.place[axis][corners.a];
    b[axis] = v.place[axis][corners.b] - a[axis];
    c[axis] = v.place[axis][corners.c] - a[axis];
  }
  const float volume =
      a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  const float away = sum_of_sizes(a);
  const float doubt = kRounding * away * away * (sum_of_sizes(b) + sum_of_sizes(c));
  return std::abs(volume) > doubt ? volume < 0 : normals_face_eye(v, corners);
}

// A handful of vertices on the stack, as kernels want them.
struct FewVertices {
  float numbers[7][9];
  std::int32_t places[2][9];
  std::uint8_t flags[9];

  Vertices view() {
    return {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}, numbers[6], places[0],
            places[1], flags};
  }
};

}  // namespace

SetUp::SetUp(const Kernels& kernels, const Projection& projection, std::int32_t width, std::int32_t height)
    : kernels_(kernels), projection_(projection), width_(width), height_(height) {}

void SetUp::add(const Dicer& diced, const PatchIdentity& identity, SetUps& out) const {
  const Vertices& v = diced.vertices();
  std::uint32_t index = 0;
  for (const Corner3& corners : diced.triangles()) {
    const int outside = v.outside[corners.a] + v.outside[corners.b] + v.outside[corners.c];
    if (outside == 0)
      add_triangle(v, corners, {index, std::nullopt}, identity, out);
    else
      add_clipped(v, corners, {index, faces_eye(v, corners)}, identity, out);
    ++index;
  }
}

void SetUp::add_clipped(const Vertices& v, const Corner3& corners, const Facing& facing,
                        const PatchIdentity& identity, SetUps& out) const {
  ClipPolygon polygon;
  for (const std::uint32_t corner : {corners.a, corners.b, corners.c}) {
    ClipVertex& vertex = polygon.vertex[static_cast<std::size_t>(polygon.count++)];
    for (int axis = 0; axis < 3; ++axis) {
      vertex.place[axis] = v.place[axis][corner];
      vertex.normal[axis] = v.normal[axis][corner];
    }
  }
  clip(projection_, polygon);
  FewVertices few;
  for (int i = 0; i < polygon.count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      few.numbers[axis][i] = polygon.vertex[static_cast<std::size_t>(i)].place[axis];
      few.numbers[3 + axis][i] = polygon.vertex[static_cast<std::size_t>(i)].normal[axis];
    }
  Projection wider = projection_;
  wider.near /= kSlack;
  wider.far *= kSlack;
  wider.guard *= kSlack;
  kernels_.project(wider, few.view(), polygon.count);
  for (std::uint32_t i = 1; static_cast<int>(i) + 1 < polygon.count; ++i) {
    const bool whole = few.flags[0] + few.flags[i] + few.flags[i + 1] == 0;  // not where numbers overflowed
    if (whole) add_triangle(few.view(), {0, i, i + 1}, facing, identity, out);
  }
}

void SetUp::add_triangle(const Vertices& v, const Corner3& corners, const Facing& facing,
                         const PatchIdentity& identity, SetUps& out) const {
  const std::uint32_t corner[3] = {corners.a, corners.b, corners.c};
  Triangle t;
  for (int i = 0; i < 3; ++i) {
    t.x[i] = v.x[corner[i]];
    t.y[i] = v.y[corner[i]];
  }
  const std::int64_t area = determinant(t);
  if (area == 0) return;
  const bool sure = std::abs(area) > kThin * (std::abs(t.x[1] - t.x[0]) + std::abs(t.y[1] - t.y[0]) +
                                              std::abs(t.x[2] - t.x[0]) + std::abs(t.y[2] - t.y[0]));
  const bool faces = facing.eye ? *facing.eye : sure ? area < 0 : faces_eye(v, corners);
  if (identity.one_sided && faces == identity.mirrored) return;
  const PlaneMaker plane(t, static_cast<float>(area));
  float w[3];
  for (int i = 0; i < 3; ++i) w[i] = v.inverse_w[corner[i]];
  t.depth = plane(w[0], w[1], w[2]);
  const float sign = faces ? 1.0f : -1.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float* n = v.normal[axis];
    t.normal[axis] = plane(sign * (n[corner[0]] * w[0]), sign * (n[corner[1]] * w[1]), sign * (n[corner[2]] * w[2]));
  }
  t.patch = identity.patch;
  t.index = facing.index;
  t.look = identity.look;
  keep(t, out);
}

void SetUp::keep(const Triangle& triangle, SetUps& out) const {
  const Crossings crossings(triangle, width_, height_);
  if (out.line_counts.empty()) {
    const auto wanted = [&](std::int32_t row) {
      return out.wanted_lines.empty() || out.wanted_lines[static_cast<std::size_t>(row)] != 0;
    };
    if (!has_edge_box(crossings, wanted)) return;
  } else {
    const std::uint32_t boxes = count_edge_boxes(crossings, out.line_counts);
    if (boxes == 0) return;
    out.edge_boxes += boxes;
  }
  ++out.touching;
  if (out.stored < out.triangles.size()) out.triangles[out.stored++] = triangle;
}

}  // namespace mars::node
