#include "node/setup.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "node/clip.h"

namespace mars::node {
namespace {

// Cut vertices lie on the planes but for rounding: they pass a projection this much wider.
constexpr float kSlack = 1.001f;

// Four floats that the compiler keeps in one register; arithmetic is lane by lane.
typedef float Float4 __attribute__((vector_size(16)));

Float4 load(const float* four) {
  Float4 out;
  std::memcpy(&out, four, sizeof out);
  return out;
}

// Edges from a triangle's first vertex, 1/256 pixel.
struct Edges {
  float x1, y1, x2, y2;
};

// The planes through the values of three vertices.
void set_planes(const Vertices& v, const Corner3& corners, const Edges& edges, float inverse, bool faces,
                Triangle& out) {
  const float sign = faces ? 1.0f : -1.0f;
  const Float4 turned = {1, sign, sign, sign};
  const Float4 first = turned * load(v.values[corners.a]);
  const Float4 d1 = turned * load(v.values[corners.b]) - first, d2 = turned * load(v.values[corners.c]) - first;
  const Float4 per_x = (d1 * edges.y2 - d2 * edges.y1) * inverse;
  const Float4 per_y = (d2 * edges.x1 - d1 * edges.x2) * inverse;
  std::memcpy(out.at_first, &first, sizeof first);
  std::memcpy(out.per_x, &per_x, sizeof per_x);
  std::memcpy(out.per_y, &per_y, sizeof per_y);
}

void set_identity(const Vertices& v, const Corner3& corners, const PatchIdentity& identity, Triangle& out) {
  out.first_x = v.x[corners.a];
  out.first_y = v.y[corners.a];
  out.patch = identity.patch;
  out.look = identity.look;
}

// An edge box in two moves: columns are first | last << 16.
void put(std::uint32_t number, std::uint32_t columns, std::int32_t row, bool moving, Crossing* out) {
  const std::uint32_t line = static_cast<std::uint32_t>(row) | std::uint32_t{moving} << 16;
  const std::uint32_t words[] = {number, columns, line};
  static_assert(offsetof(Crossing, line) == 8 && sizeof words == sizeof *out);
  std::memcpy(out, words, sizeof words);
}

// Counts the edge boxes of rows [first, last) and stores them if there is room for the triangle too; whether there
// were any and they were stored.
bool cross(const Outline& outline, bool moving, SetUps& out) {
  const std::int32_t first = outline.first_row, last = std::max(first, outline.last_row);
  const bool room =
      reinterpret_cast<std::byte*>(out.next + 1) <= reinterpret_cast<std::byte*>(out.crossing - (last - first));
  const auto number = static_cast<std::uint32_t>(out.next - out.first);
  std::uint32_t boxes = 0;
  for (std::int32_t row = first; row < last; ++row) {
    const Outline::Columns columns = outline.columns(row);
    if (columns.first >= columns.last || out.wanted_lines[static_cast<std::size_t>(row)] == 0) continue;
    if (room) put(number, static_cast<std::uint32_t>(columns.first | columns.last << 16), row, moving, --out.crossing);
    ++out.line_counts[static_cast<std::size_t>(row)];
    ++boxes;
  }
  out.edge_boxes += boxes;
  out.touching += boxes > 0;
  return room && boxes > 0;
}

// Memory that no batch exceeds.
constexpr std::ptrdiff_t kBatchBytes = kExamined * (sizeof(Triangle) + kMostExtent * sizeof(Crossing));

// Twice the area in 1/65536 square pixel; y grows downwards, so negative where counter-clockwise to the eye.
std::int64_t determinant(const Corners& t) {
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

// A clipped triangle has at most nine corners.
constexpr int kFew = 9 + kVectorSlack;

// A handful of vertices on the stack, as kernels want them.
struct FewVertices {
  float numbers[6][kFew];
  std::int32_t places[2][kFew];
  std::uint8_t flags[kFew];
  alignas(64) float values[kFew][kValues];

  Vertices view() {
    return {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}, values, places[0], places[1], flags};
  }
};

}  // namespace

SetUps::SetUps(std::span<std::byte> memory, std::span<std::uint32_t> line_counts,
               std::span<const std::uint8_t> wanted_lines)
    : first(reinterpret_cast<Triangle*>(memory.data())),
      next(first),
      crossing(reinterpret_cast<Crossing*>(memory.data() + memory.size())),
      end(crossing),
      line_counts(line_counts),
      wanted_lines(wanted_lines) {}

SetUp::SetUp(const Kernels& kernels, const Projection& projection, std::int32_t width, std::int32_t height)
    : kernels_(kernels), projection_(projection), width_(width), height_(height) {}

void SetUp::add(const Dicer& diced, const PatchIdentity& identity, SetUps& out) {
  if (diced.reaches_outside()) return add_plainly(diced, identity, out);
  const Vertices& v = diced.vertices();
  const Triangles& triangles = diced.triangles();
  const Examination task{width_, height_, identity.one_sided, identity.mirrored};
  for (const Batch& batch : std::span(triangles.batches, triangles.batch_count)) {
    const bool room = reinterpret_cast<std::byte*>(out.crossing) - reinterpret_cast<std::byte*>(out.next) >= kBatchBytes;
    if (room)
      kernels_.examine(task, v, triangles, batch, examined_);
    else
      examined_.decided = 0, examined_.undecided = (1u << (batch.last - batch.first)) - 1;
    if ((examined_.decided | examined_.undecided) != 0) add_batch(v, triangles, batch, identity, out);
  }
}

void SetUp::add_batch(const Vertices& v, const Triangles& triangles, const Batch& batch,
                      const PatchIdentity& identity, SetUps& out) {
  const Examined& e = examined_;
  Triangle* next = out.next;
  Crossing* crossing = out.crossing;
  const auto store = [&] {
    out.touching += static_cast<std::uint64_t>(next - out.next);
    out.edge_boxes += static_cast<std::uint64_t>(out.crossing - crossing);
    out.next = next;
    out.crossing = crossing;
  };
  for (std::uint32_t left = e.decided | e.undecided; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
    const Corner3 corners = triangles[batch.first + lane];
    if (e.undecided >> lane & 1) {
      store();
      add_whole(v, corners, std::nullopt, identity, out);
      next = out.next;
      crossing = out.crossing;
      continue;
    }
    const Crossing* const before = crossing;
    const std::uint32_t* columns = &e.columns[0][lane];
    for (std::int32_t row = e.first_row[lane]; row < e.last_row[lane]; ++row, columns += kExamined) {
      const bool kept = (*columns != 0) & (out.wanted_lines[static_cast<std::size_t>(row)] != 0);
      put(static_cast<std::uint32_t>(next - out.first), *columns, row, identity.moving, crossing - 1);
      crossing -= kept;
      out.line_counts[static_cast<std::size_t>(row)] += kept;
    }
    if (crossing == before) continue;
    set_identity(v, corners, identity, *next);
    set_planes(v, corners, {e.x1[lane], e.y1[lane], e.x2[lane], e.y2[lane]}, e.inverse[lane], (e.faces >> lane & 1) != 0, *next);
    ++next;
  }
  store();
}

void SetUp::add_plainly(const Dicer& diced, const PatchIdentity& identity, SetUps& out) const {
  for (std::uint32_t k = 0; k < diced.triangles().count; ++k)
    add_one(diced.vertices(), diced.triangles()[k], identity, out);
}

void SetUp::add_one(const Vertices& v, const Corner3& corners, const PatchIdentity& identity, SetUps& out) const {
  const int outside = v.outside[corners.a] + v.outside[corners.b] + v.outside[corners.c];
  if (outside == 0)
    add_whole(v, corners, std::nullopt, identity, out);
  else
    add_clipped(v, corners, identity, out);
}

void SetUp::add_clipped(const Vertices& v, const Corner3& corners, const PatchIdentity& identity,
                        SetUps& out) const {
  ClipPolygon polygon;
  for (const std::uint32_t corner : {corners.a, corners.b, corners.c}) {
    ClipVertex& vertex = polygon.vertex[static_cast<std::size_t>(polygon.count++)];
    for (int axis = 0; axis < 3; ++axis) {
      vertex.place[axis] = v.place[axis][corner];
      vertex.normal[axis] = v.normal[axis][corner];
    }
  }
  clip(projection_, polygon);
  FewVertices few{};
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
  const bool faces = faces_eye(v, corners);
  for (std::uint32_t i = 1; static_cast<int>(i) + 1 < polygon.count; ++i) {
    const bool whole = few.flags[0] + few.flags[i] + few.flags[i + 1] == 0;  // not where numbers overflowed
    if (whole) add_whole(few.view(), {0, i, i + 1}, faces, identity, out);
  }
}

void SetUp::add_whole(const Vertices& v, const Corner3& corners, std::optional<bool> known,
                      const PatchIdentity& identity, SetUps& out) const {
  const std::uint32_t corner[3] = {corners.a, corners.b, corners.c};
  Corners t;
  for (int i = 0; i < 3; ++i) {
    t.x[i] = v.x[corner[i]];
    t.y[i] = v.y[corner[i]];
  }
  const std::int64_t area = determinant(t);
  if (area == 0) return;
  const bool sure = std::abs(area) > kThin * (std::abs(t.x[1] - t.x[0]) + std::abs(t.y[1] - t.y[0]) +
                                              std::abs(t.x[2] - t.x[0]) + std::abs(t.y[2] - t.y[0]));
  const bool faces = known ? *known : sure ? area < 0 : faces_eye(v, corners);
  if (identity.one_sided && faces == identity.mirrored) return;
  const Outline outline(t, width_, height_);
  if (!cross(outline, identity.moving, out)) return;
  const Edges edges{static_cast<float>(t.x[1] - t.x[0]), static_cast<float>(t.y[1] - t.y[0]),
                    static_cast<float>(t.x[2] - t.x[0]), static_cast<float>(t.y[2] - t.y[0])};
  set_identity(v, corners, identity, *out.next);
  set_planes(v, corners, edges, 1.0f / static_cast<float>(area), faces, *out.next++);
}

}  // namespace mars::node
