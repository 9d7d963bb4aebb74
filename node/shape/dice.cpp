#include "node/shape/dice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mars::shape {
namespace {

constexpr int kMostTriangles = 2 * kMaxRate * kMaxRate + 8 * kMaxRate;
constexpr int kMostBatches = 2 * kMaxRate * (kMaxRate / static_cast<int>(kBatchTriangles) + 1) + 4 * kMaxRate;
constexpr Side kSides[] = {Side::bottom, Side::right, Side::top, Side::left};

void subtract(const float* a, const float* b, float* out) {
  for (int axis = 0; axis < 3; ++axis) out[axis] = a[axis] - b[axis];
}

void set_slopes(Row& row) {
  for (int i = 0; i < 3; ++i) subtract(row.point[i + 1], row.point[i], row.slope[i]);
}

// The row of constant v at step j of `basis`, along u. A patch's row of points is twelve numbers on end, as is the
// result's, so that these loops become vectors.
Row inside_row(const EyePatch& patch, const Basis& basis, int j) {
  constexpr int kNumbers = 12;
  Row row;
  const float* p = patch.point[0];
  float* point = row.point[0];
  float* cross = row.cross[0];
  const float c[4] = {basis.cubic[0][j], basis.cubic[1][j], basis.cubic[2][j], basis.cubic[3][j]};
  const float q[3] = {basis.quadratic[0][j], basis.quadratic[1][j], basis.quadratic[2][j]};
  for (int n = 0; n < kNumbers; ++n) {
    const float p0 = p[n], p1 = p[n + kNumbers], p2 = p[n + 2 * kNumbers], p3 = p[n + 3 * kNumbers];
    point[n] = c[0] * p0 + c[1] * p1 + c[2] * p2 + c[3] * p3;
    cross[n] = q[0] * (p1 - p0) + q[1] * (p2 - p1) + q[2] * (p3 - p2);
  }
  set_slopes(row);
  row.sign = 1;
  return row;
}

// The row along a side in its canonical direction. `along x across` is the outside for bottom and top, where
// u runs along; for left and right, where v does, and where the direction is reversed, it is the inside.
Row side_row(const EyePatch& patch, Side side) {
  constexpr int first[] = {0, 3, 12, 0}, stride[] = {1, 4, 1, 4};
  constexpr int outer[] = {4, 0, 0, 1}, inner[] = {0, -1, -4, 0};  // cross = point + outer - (point + inner)
  const auto s = static_cast<std::size_t>(side);
  const Edge canonical = edge(patch, side);
  Row row{};
  for (int i = 0; i < 4; ++i) {
    const int at = first[s] + stride[s] * (canonical.reversed ? 3 - i : i);
    std::copy_n(canonical.curve.point[i], 3, row.point[i]);
    subtract(patch.point[at + outer[s]], patch.point[at + inner[s]], row.cross[i]);
  }
  set_slopes(row);
  const bool along_v = side == Side::left || side == Side::right;
  row.sign = along_v != canonical.reversed ? -1.0f : 1.0f;
  return row;
}

}  // namespace

Dicer::Dicer(simd::InstructionSet set) : Surface(set, kMostVertices, kMostTriangles, kMostBatches) {}

void Dicer::dice(const EyePatch& patch, const Projection& projection, const Dicing& dicing) {
  const Rates wanted = rates(kernels_, patch, projection, dicing);
  lay_out(wanted);
  bool normals = evaluate_inside(patch);
  for (const Side side : kSides) normals &= evaluate_side(patch, side);
  if (!normals) mend_normals(patch);
  project(projection);
  if (wanted != triangulated_) triangulate();
  triangulated_ = wanted;
}

// Decides between grid and strip, and where each side's vertices stand.
void Dicer::lay_out(const Rates& wanted) {
  rates_ = wanted;
  const auto side = [&](Side s) { return rates_.side[static_cast<int>(s)]; };
  flat_in_v_ = rates_.v == 1 && side(Side::left) == 1 && side(Side::right) == 1;
  const bool flat_in_u = rates_.u == 1 && side(Side::bottom) == 1 && side(Side::top) == 1;
  rates_.u = std::max(rates_.u, 2);
  rates_.v = std::max(rates_.v, 2);
  const bool strip = flat_in_v_ || flat_in_u;
  columns_ = strip ? 0 : rates_.u - 1;
  rows_ = strip ? 0 : rates_.v - 1;
  vertex_count_ = columns_ * rows_;
  for (int s = 0; s < 4; ++s) {
    side_at_[s] = vertex_count_;
    vertex_count_ += rates_.side[s] + 1;
  }
}

bool Dicer::evaluate_inside(const EyePatch& patch) {
  const Basis& along = basis(rates_.u);
  const Basis& up = basis(rates_.v);
  bool normals = true;
  for (int j = 1; j <= rows_; ++j)
    normals &= kernels_.evaluate(inside_row(patch, up, j), along, 1, rates_.u, vertices_, (j - 1) * columns_);
  return normals;
}

bool Dicer::evaluate_side(const EyePatch& patch, Side side) {
  const int s = static_cast<int>(side);
  const int rate = rates_.side[s];
  const int at = side_at_[s];
  const bool normals = kernels_.evaluate(side_row(patch, side), basis(rate), 0, rate + 1, vertices_, at);
  if (!edge(patch, side).reversed) return normals;
  for (float* component : {vertices_.place[0], vertices_.place[1], vertices_.place[2], vertices_.normal[0],
                           vertices_.normal[1], vertices_.normal[2]})
    std::reverse(component + at, component + at + rate + 1);
  return normals;
}

// Where a side is collapsed or its tangents vanish the surface's normal is that of a place just inside.
void Dicer::mend_normals(const EyePatch& patch) {
  const auto missing = [&](int k) {
    return vertices_.normal[0][k] == 0 && vertices_.normal[1][k] == 0 && vertices_.normal[2][k] == 0;
  };
  for (int k = 0; k < columns_ * rows_; ++k) {
    const int i = k % columns_ + 1, j = k / columns_ + 1;
    if (missing(k)) mend_normal(patch, k, static_cast<float>(i) / rates_.u, static_cast<float>(j) / rates_.v);
  }
  for (const Side side : kSides) {
    const int s = static_cast<int>(side);
    const bool along_u = side == Side::bottom || side == Side::top;
    const float across = side == Side::bottom || side == Side::left ? 0.0f : 1.0f;
    for (int i = 0; i <= rates_.side[s]; ++i) {
      const float along = static_cast<float>(i) / rates_.side[s];
      if (missing(side_at_[s] + i))
        mend_normal(patch, side_at_[s] + i, along_u ? along : across, along_u ? across : along);
    }
  }
}

void Dicer::mend_normal(const EyePatch& patch, int vertex, float u, float v) {
  constexpr float kInward = 1.0f / 512;  // of the way to the patch's middle
  const float t[2] = {u + (0.5f - u) * kInward, v + (0.5f - v) * kInward};
  float cubic[2][4], slope[2][4];
  for (int k = 0; k < 2; ++k) {
    const float a = t[k], b = 1 - a;
    const float c[4] = {b * b * b, 3 * b * b * a, 3 * b * a * a, a * a * a};
    const float d[4] = {-b * b, b * b - 2 * a * b, 2 * a * b - a * a, a * a};
    std::copy_n(c, 4, cubic[k]);
    std::copy_n(d, 4, slope[k]);
  }
  float du[3] = {}, dv[3] = {};
  for (int i = 0; i < 16; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      du[axis] += slope[0][i % 4] * cubic[1][i / 4] * patch.point[i][axis];
      dv[axis] += cubic[0][i % 4] * slope[1][i / 4] * patch.point[i][axis];
    }
  const float n[3] = {du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2], du[0] * dv[1] - du[1] * dv[0]};
  const float square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  const float scale = square > 0 ? 1 / std::sqrt(square) : 0;
  for (int axis = 0; axis < 3; ++axis) vertices_.normal[axis][vertex] = n[axis] * scale;
}

void Dicer::triangulate() {
  clear_triangles();
  if (columns_ > 0) {
    fill_inside();
    for (const Side side : kSides) stitch(side_chain(side), inner_chain(side));
    end_batches(false);
    return;
  }
  const Side near = flat_in_v_ ? Side::bottom : Side::right;
  Chain opposite = side_chain(flat_in_v_ ? Side::top : Side::left);
  opposite.first += opposite.steps * opposite.stride;  // both run the same way
  opposite.stride = -opposite.stride;
  stitch(side_chain(near), opposite);
  end_batches(false);
}

// Row by row the lower triangles of its quads, then the upper ones: each row's are consecutive. Rows so short that most
// of a batch would lie idle share theirs.
void Dicer::fill_inside() {
  const bool long_rows = columns_ - 1 > static_cast<int>(kBatchTriangles) / 2;
  for (int j = 0; j + 1 < rows_; ++j) {
    const int first = j * columns_, last = first + columns_ - 1;
    for (int a = first; a < last; ++a) add(a, a + 1, a + columns_ + 1);
    if (long_rows) end_batches(true);
    for (int a = first; a < last; ++a) add(a, a + columns_ + 1, a + columns_);
    if (long_rows) end_batches(true);
  }
}

// Triangles between two chains that run the same way, inner to the left of outer: at each step the chain whose
// next vertex comes first goes on.
void Dicer::stitch(const Chain& outer, const Chain& inner) {
  std::int32_t o = 0, i = 0;
  while (o < outer.steps || i < inner.steps) {
    const auto next_outer = static_cast<std::int64_t>(outer.from + o + 1) * inner.of;
    const auto next_inner = static_cast<std::int64_t>(inner.from + i + 1) * outer.of;
    const std::int32_t at_outer = outer.first + o * outer.stride;
    const std::int32_t at_inner = inner.first + i * inner.stride;
    if (i == inner.steps || (o < outer.steps && next_outer <= next_inner)) {
      add(at_outer, at_outer + outer.stride, at_inner);
      ++o;
    } else {
      add(at_outer, at_inner + inner.stride, at_inner);
      ++i;
    }
  }
}

Dicer::Chain Dicer::side_chain(Side side) const {
  const int s = static_cast<int>(side);
  const int rate = rates_.side[s];
  const bool forward = side == Side::bottom || side == Side::right;
  return {forward ? side_at_[s] : side_at_[s] + rate, forward ? 1 : -1, rate, 0, rate};
}

Dicer::Chain Dicer::inner_chain(Side side) const {
  const int last_row = (rows_ - 1) * columns_;
  switch (side) {
    case Side::bottom: return {0, 1, columns_ - 1, 1, rates_.u};
    case Side::right: return {columns_ - 1, columns_, rows_ - 1, 1, rates_.v};
    case Side::top: return {last_row + columns_ - 1, -1, columns_ - 1, 1, rates_.u};
    default: return {last_row, -columns_, rows_ - 1, 1, rates_.v};
  }
}

}  // namespace mars::shape
