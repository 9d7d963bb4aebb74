// Set-ups as they are stored: a triangle's planes for all four values at once, and its edge boxes.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "node/raster/kernels/functions.h"

namespace mars::raster::MARS_SET {
namespace {

// Fetched ahead of what is stored: processors do not do it beyond a page.
constexpr int kTrianglesAhead = 16;
constexpr int kBoxesAhead = 64;

// Four floats in one register; arithmetic is lane by lane.
typedef float Float4 __attribute__((vector_size(16)));

Float4 load(const float* four) {
  Float4 out;
  std::memcpy(&out, four, sizeof out);
  return out;
}

// An edge box in two moves: `part` is EdgeBox::packed.
void put(std::uint32_t number, std::uint32_t part, std::uint32_t line_and_moving, UnsortedEdgeBox* out) {
  static_assert(offsetof(UnsortedEdgeBox, line) == 8 && offsetof(UnsortedEdgeBox, moving) == 10 && sizeof *out == 12);
  const std::uint64_t box = number | std::uint64_t{part} << 32;
  std::memcpy(out, &box, sizeof box);
  std::memcpy(reinterpret_cast<std::byte*>(out) + sizeof box, &line_and_moving, sizeof line_and_moving);
}

// Rows [first, last) of a line.
struct RowRange {
  std::uint32_t first;
  std::uint32_t last;
};

// What edge boxes have in common.
struct BoxesOfLine {
  std::uint32_t triangle;
  std::uint32_t line;
  std::uint32_t last_sample;
  bool moving;
};

// The edge boxes of one line. Without a branch: which rows are covered is not foreseen.
[[gnu::always_inline]] inline void emit_line(const Classified& c, std::uint32_t lane, RowRange rows,
                                             const BoxesOfLine& common, SetUpSpace& space) {
  const std::uint32_t wanted = -std::uint32_t{space.wanted_lines[common.line]};
  const std::uint32_t line_and_moving = common.line | std::uint32_t{common.moving} << 16;
  LineLoad load;
  for (std::uint32_t row = rows.first; row < rows.last; ++row) {
    const std::uint32_t columns = c.columns[row][lane] & wanted;
    const bool covers = columns != 0;
    UnsortedEdgeBox* const box = space.last_box - 1;
    put(common.triangle, EdgeBox::packed(columns, row & common.last_sample), line_and_moving, box);
    space.last_box = covers ? box : space.last_box;
    load += LineLoad(covers, (columns >> 16) - (columns & 0xffff));
  }
  space.line_loads[common.line] += load;
}

}  // namespace

void set_up_planes(const shape::Vertices& v, const shape::Corner3& corners, const ScreenShape& shape,
                   const PatchIdentity& identity, geometry::Triangle& out) {
  const float sign = shape.faces || v.colors ? 1.0f : -1.0f;
  const float(*values)[shape::kValues] = v.colors ? v.colors[shape.faces ? 0 : 1].values : v.values;
  const Float4 turned = {1, sign, sign, sign};
  const Float4 first = turned * load(values[corners.a]);
  const Float4 d1 = turned * load(values[corners.b]) - first, d2 = turned * load(values[corners.c]) - first;
  const Float4 per_x = (d1 * shape.y2 - d2 * shape.y1) * shape.inverse;
  const Float4 per_y = (d2 * shape.x1 - d1 * shape.x2) * shape.inverse;
  std::memcpy(out.at_first, &first, sizeof first);
  std::memcpy(out.per_x, &per_x, sizeof per_x);
  std::memcpy(out.per_y, &per_y, sizeof per_y);
  out.first_x = v.x[corners.a];
  out.first_y = v.y[corners.a];
  out.patch = identity.patch;
  out.material = identity.material;
}

void emit(const shape::Vertices& v, const shape::Triangles& triangles, const shape::Batch& batch, const Classified& c,
          std::uint32_t lanes, const PatchIdentity& identity, SetUpSpace& out) {
  SetUpSpace space = out;
  const std::uint32_t last_sample = (1u << space.log2_samples) - 1;
  for (std::uint32_t left = lanes & c.decided; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
    const UnsortedEdgeBox* const before = space.last_box;
    __builtin_prefetch(space.next + kTrianglesAhead, 1);
    __builtin_prefetch(space.last_box - kBoxesAhead, 1);
    const auto number = static_cast<std::uint32_t>(space.next - space.first);
    const auto last_row = static_cast<std::uint32_t>(c.last_row[lane]);
    auto line = static_cast<std::uint32_t>(c.first_line[lane]);
    if (last_sample == 0) {
      for (auto row = static_cast<std::uint32_t>(c.first_row[lane]); row < last_row; ++row, ++line)
        emit_line(c, lane, {row, row + 1}, {number, line, 0, identity.moving}, space);
    } else {
      for (auto row = static_cast<std::uint32_t>(c.first_row[lane]); row < last_row; ++line) {
        const std::uint32_t end = (row | last_sample) + 1;
        emit_line(c, lane, {row, end < last_row ? end : last_row}, {number, line, last_sample, identity.moving}, space);
        row = end;
      }
    }
    if (space.last_box == before) continue;
    const std::uint32_t k = batch.first + lane;
    set_up_planes(v, {triangles.a[k], triangles.b[k], triangles.c[k]},
                  {c.x1[lane], c.y1[lane], c.x2[lane], c.y2[lane], c.inverse[lane], (c.faces >> lane & 1) != 0},
                  identity, *space.next++);
  }
  out = space;
}

}  // namespace mars::raster::MARS_SET
