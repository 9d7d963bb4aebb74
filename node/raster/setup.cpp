#include "node/raster/setup.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "node/geometry/clip.h"
#include "node/raster/outline.h"

namespace mars::raster {
namespace {

// Cut vertices lie on the planes but for rounding: they pass a projection this much wider.
constexpr float kSlack = 1.001f;

// Calls visit(line, sample, left, right) for each edge box on a wanted line; how many there are.
template <typename Visit>
std::uint32_t for_boxes(const Outline& outline, const SetUps& out, Visit visit) {
  const auto first = static_cast<std::uint32_t>(outline.first_row);
  const auto last = static_cast<std::uint32_t>(std::max(outline.first_row, outline.last_row));
  std::uint32_t boxes = 0;
  for (std::uint32_t row = first; row < last; ++row) {
    const std::uint32_t line = row >> out.log2_samples, sample = row - (line << out.log2_samples);
    if (out.wanted_lines[line] == 0) continue;
    const Outline::Columns columns = outline.columns(static_cast<std::int32_t>(row));
    if (columns.first >= columns.last) continue;
    visit(line, sample, static_cast<std::uint32_t>(columns.first), static_cast<std::uint32_t>(columns.last));
    ++boxes;
  }
  return boxes;
}

// Of a tall triangle, all rows may not fit where those on the wanted lines do.
bool fits(const Outline& outline, const SetUps& out) {
  const auto rows = static_cast<std::size_t>(std::max(0, outline.last_row - outline.first_row));
  const auto with = [](std::size_t boxes) { return sizeof(geometry::Triangle) + boxes * sizeof(UnsortedEdgeBox); };
  if (out.bytes_left() >= with(rows)) return true;
  return out.bytes_left() >= with(for_boxes(outline, out, [](auto...) {}));
}

// Counts the edge boxes and stores them if the triangle fits too; whether there were any and they were stored.
bool add_boxes(const Outline& outline, bool moving, SetUps& out) {
  const bool stores = fits(outline, out);
  const auto number = static_cast<std::uint32_t>(out.next - out.first);
  const std::uint32_t boxes =
      for_boxes(outline, out, [&](std::uint32_t line, std::uint32_t sample, std::uint32_t left, std::uint32_t right) {
        if (stores)
          *--out.last_box = {{number, left, right - left - 1, sample}, static_cast<std::uint16_t>(line), moving};
        out.line_loads[line] += LineLoad(1, right - left);
      });
  out.edge_boxes += boxes;
  out.touching += boxes > 0;
  return stores && boxes > 0;
}

// Memory that a batch does not exceed in a picture of this height and number of samples a pixel.
std::size_t most_bytes(const Classified& c, std::int32_t height, std::int32_t samples) {
  const std::int32_t rows = samples * (c.undecided == 0 ? kMostExtent : std::max(kMostExtent, height));
  return shape::kBatchTriangles *
         (sizeof(geometry::Triangle) + static_cast<std::size_t>(rows) * sizeof(UnsortedEdgeBox));
}

// Twice the area in 1/65536 square pixel; y grows downwards, so negative where counter-clockwise to the eye.
std::int64_t determinant(const Corners& t) {
  const std::int64_t x1 = t.x[1] - t.x[0], x2 = t.x[2] - t.x[0];
  const std::int64_t y1 = t.y[1] - t.y[0], y2 = t.y[2] - t.y[0];
  return x1 * y2 - x2 * y1;
}

float sum_of_sizes(const float* a) { return std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]); }

// Whether the surface's outside by the vertices' normals is turned to the eye, on average.
bool normals_face_eye(const shape::Vertices& v, const shape::Corner3& corners, bool parallel) {
  float toward = 0;
  for (const std::uint32_t corner : {corners.a, corners.b, corners.c})
    if (parallel)
      toward += v.normal[2][corner];
    else
      for (int axis = 0; axis < 3; ++axis) toward -= v.normal[axis][corner] * v.place[axis][corner];
  return toward > 0;
}

// Whether the eye is on the side of the triangle to which (b - a) x (c - a) points. Asked of the places before
// snapping, which can turn a thin triangle over; where even these are in a line but for rounding (beside the
// tip of a cone), the normals decide. Else such a triangle would be lit from behind.
bool faces_eye(const shape::Vertices& v, const shape::Corner3& corners, bool parallel) {
  constexpr float kRounding = 1e-6f;
  float a[3], b[3], c[3];
  for (int axis = 0; axis < 3; ++axis) {
    a[axis] = v.place[axis][corners.a];
    b[axis] = v.place[axis][corners.b] - a[axis];
    c[axis] = v.place[axis][corners.c] - a[axis];
  }
  const float away = sum_of_sizes(a), sides = sum_of_sizes(b) + sum_of_sizes(c);
  const float across = b[0] * c[1] - b[1] * c[0];
  if (parallel) {
    const bool sure = std::abs(across) > kRounding * away * sides;
    return sure ? across > 0 : normals_face_eye(v, corners, parallel);
  }
  const float volume = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * across;
  const float doubt = kRounding * away * away * sides;
  return std::abs(volume) > doubt ? volume < 0 : normals_face_eye(v, corners, parallel);
}

// Of a piece of a clipped triangle. Its corners may be as far out as the guard band, where differences of products of
// floats have few digits left.
void set_depth_exactly(const shape::Vertices& v, const shape::Corner3& corners, const Corners& t, std::int64_t area,
                       geometry::Triangle& out) {
  const double first = v.values[corners.a][shape::kDepth];
  const double d1 = v.values[corners.b][shape::kDepth] - first, d2 = v.values[corners.c][shape::kDepth] - first;
  const double x1 = t.x[1] - t.x[0], y1 = t.y[1] - t.y[0], x2 = t.x[2] - t.x[0], y2 = t.y[2] - t.y[0];
  out.per_x[shape::kDepth] = static_cast<float>((d1 * y2 - d2 * y1) / static_cast<double>(area));
  out.per_y[shape::kDepth] = static_cast<float>((d2 * x1 - d1 * x2) / static_cast<double>(area));
}

// A clipped triangle has at most nine corners.
constexpr int kFew = 9 + simd::kVectorSlack;

// A handful of vertices on the stack, as kernels want them.
struct FewVertices {
  float numbers[6][kFew];
  std::int32_t places[2][kFew];
  std::uint8_t flags[kFew];
  alignas(64) float values[kFew][shape::kValues];

  shape::Vertices view() {
    return {{numbers[0], numbers[1], numbers[2]},
            {numbers[3], numbers[4], numbers[5]},
            values,
            places[0],
            places[1],
            flags};
  }
};

}  // namespace

SetUps::SetUps(std::span<std::byte> memory, geometry::Triangle* first, const shape::SamplePattern& pattern,
               std::span<LineLoad> line_loads) {
  this->first = first;
  log2_samples = static_cast<std::uint32_t>(pattern.log2_count);
  begin = next = reinterpret_cast<geometry::Triangle*>(memory.data());
  last_box = end = reinterpret_cast<UnsortedEdgeBox*>(memory.data() + memory.size());
  this->line_loads = line_loads.data();
  wanted_lines = nullptr;
}

std::size_t SetUps::bytes_left() const {
  return static_cast<std::size_t>(reinterpret_cast<std::byte*>(last_box) - reinterpret_cast<std::byte*>(next));
}

SetUp::SetUp(simd::InstructionSet set, const shape::Projection& projection, std::int32_t width, std::int32_t height,
             const shape::SamplePattern& pattern, bool casting)
    : shape_kernels_(shape::shape_kernels(set)),
      kernels_(raster_kernels(set)),
      projection_(projection),
      width_(width),
      height_(height),
      pattern_(pattern),
      casting_(casting) {}

void SetUp::add(const shape::Surface& surface, const PatchIdentity& identity, SetUps& out) {
  if (surface.reaches_outside()) return add_plainly(surface, identity, out);
  const shape::Vertices& v = surface.vertices();
  const shape::Triangles& triangles = surface.triangles();
  const ClassifyTask task{width_, height_, pattern_, identity.one_sided, identity.mirrored};
  for (const shape::Batch& batch : std::span(triangles.batches, triangles.batch_count)) {
    kernels_.classify(task, v, triangles, batch, classified_);
    if (out.bytes_left() < most_bytes(classified_, height_, pattern_.count))
      classified_.undecided |= std::exchange(classified_.decided, 0u);
    if ((classified_.decided | classified_.undecided) != 0) add_batch(v, triangles, batch, identity, out);
  }
}

// In the order of the batch: decided ones up to the next undecided one, and so on.
void SetUp::add_batch(const shape::Vertices& v, const shape::Triangles& triangles, const shape::Batch& batch,
                      const PatchIdentity& identity, SetUps& out) const {
  constexpr std::uint32_t kAll = 0xffffffffu;
  const auto emit = [&](std::uint32_t lanes) {
    const SetUpSpace before = out;
    kernels_.emit(v, triangles, batch, classified_, lanes, identity, out);
    out.touching += static_cast<std::uint64_t>(out.next - before.next);
    out.edge_boxes += static_cast<std::uint64_t>(before.last_box - out.last_box);
  };
  std::uint32_t rest = kAll;
  for (std::uint32_t left = classified_.undecided; left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    emit(rest & ~(kAll << lane));
    add_whole(v, triangles[batch.first + static_cast<std::uint32_t>(lane)], std::nullopt, identity, out);
    rest = kAll << lane;
  }
  emit(rest);
}

void SetUp::add_plainly(const shape::Surface& surface, const PatchIdentity& identity, SetUps& out) const {
  for (std::uint32_t k = 0; k < surface.triangles().count; ++k)
    add_one(surface.vertices(), surface.triangles()[k], identity, out);
}

void SetUp::add_one(const shape::Vertices& v, const shape::Corner3& corners, const PatchIdentity& identity,
                    SetUps& out) const {
  const int outside = v.outside[corners.a] + v.outside[corners.b] + v.outside[corners.c];
  if (outside == 0)
    add_whole(v, corners, std::nullopt, identity, out);
  else
    add_clipped(v, corners, identity, out);
}

void SetUp::add_clipped(const shape::Vertices& v, const shape::Corner3& corners, const PatchIdentity& identity,
                        SetUps& out) const {
  const bool faces = faces_eye(v, corners, projection_.parallel);
  const auto* varying = v.colors ? v.colors[faces ? 0 : 1].color : v.normal;
  geometry::ClipPolygon polygon;
  for (const std::uint32_t corner : {corners.a, corners.b, corners.c}) {
    geometry::ClipVertex& vertex = polygon.vertex[static_cast<std::size_t>(polygon.count++)];
    for (int axis = 0; axis < 3; ++axis) {
      vertex.place[axis] = v.place[axis][corner];
      vertex.varying[axis] = varying[axis][corner];
    }
  }
  geometry::clip(projection_, polygon);
  FewVertices few{};
  for (int i = 0; i < polygon.count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      few.numbers[axis][i] = polygon.vertex[static_cast<std::size_t>(i)].place[axis];
      few.numbers[3 + axis][i] = polygon.vertex[static_cast<std::size_t>(i)].varying[axis];
    }
  shape::Projection wider = projection_;
  wider.near /= kSlack;
  wider.far *= kSlack;
  wider.guard *= kSlack;
  shape_kernels_.project(wider, few.view(), polygon.count);
  const shape::VertexColors colors[2] = {{{}, few.values}, {{}, few.values}};
  shape::Vertices cut = few.view();
  if (v.colors) cut.colors = colors;
  for (std::uint32_t i = 1; static_cast<int>(i) + 1 < polygon.count; ++i) {
    const bool whole = few.flags[0] + few.flags[i] + few.flags[i + 1] == 0;  // not where numbers overflowed
    if (whole) add_whole(cut, {0, i, i + 1}, faces, identity, out);
  }
}

void SetUp::add_whole(const shape::Vertices& v, const shape::Corner3& corners, std::optional<bool> known,
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
  const bool faces = known ? *known : sure ? area < 0 : faces_eye(v, corners, projection_.parallel);
  if (identity.one_sided && faces == identity.mirrored) return;
  const Outline outline(t, width_, height_, pattern_);
  if (!add_boxes(outline, identity.moving, out)) return;
  const ScreenShape shape{static_cast<float>(t.x[1] - t.x[0]), static_cast<float>(t.y[1] - t.y[0]),
                          static_cast<float>(t.x[2] - t.x[0]), static_cast<float>(t.y[2] - t.y[0]),
                          1.0f / static_cast<float>(area),     faces};
  kernels_.set_up_planes(v, corners, shape, identity, *out.next);
  if (casting_ && known) set_depth_exactly(v, corners, t, area, *out.next);
  ++out.next;
}

}  // namespace mars::raster
