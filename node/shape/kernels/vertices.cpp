// Points and normals of a patch or a mesh, and where they lie on the screen.
#include <cstddef>
#include <cstring>

#include "node/shape/kernels/functions.h"

namespace mars::shape::MARS_SET {

using namespace simd::MARS_SET;

namespace {

Floats sum_of_squares(Floats x, Floats y, Floats z) {
  return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

Floats cross_term(Floats a, Floats b, Floats c, Floats d) { return hn::Sub(hn::Mul(a, b), hn::Mul(c, d)); }

// The sum of numbers times coordinates.
Floats product(const Floats (&numbers)[3], const Floats (&coordinates)[3]) {
  const Floats xy = hn::Add(hn::Mul(numbers[0], coordinates[0]), hn::Mul(numbers[1], coordinates[1]));
  return hn::Add(xy, hn::Mul(numbers[2], coordinates[2]));
}

void store_unit(const Floats (&vector)[3], int at, float* const (&out)[3]) {
  const Floats square = sum_of_squares(vector[0], vector[1], vector[2]);
  const auto missing = hn::Not(hn::Gt(square, hn::Zero(kFloats)));
  const Floats scale = hn::IfThenZeroElse(missing, hn::Div(constant(1.0f), hn::Sqrt(square)));
  for (int axis = 0; axis < 3; ++axis) hn::StoreU(hn::Mul(vector[axis], scale), kFloats, out[axis] + at);
}

// One component of a sum of `Count` points, each times its weight.
template <int Count>
struct Blend {
  Floats weight[Count];

  Blend(const float* const* table, int at) {
    for (int i = 0; i < Count; ++i) weight[i] = hn::LoadU(kFloats, table[i] + at);
  }
  Floats of(const float (*points)[3], int axis) const {
    Floats sum = hn::Mul(weight[0], constant(points[0][axis]));
    for (int i = 1; i < Count; ++i) sum = hn::Add(sum, hn::Mul(weight[i], constant(points[i][axis])));
    return sum;
  }
};

}  // namespace

bool evaluate(const Row& row, const Basis& basis, int first, int last, const Vertices& out, int at) {
  bool all = true;
  for (int k = first; k < last; k += kLanes, at += kLanes) {
    const Blend<4> cubic(basis.cubic, k);
    const Blend<3> quadratic(basis.quadratic, k);
    Floats u[3], v[3];
    for (int axis = 0; axis < 3; ++axis) {
      hn::StoreU(cubic.of(row.point, axis), kFloats, out.place[axis] + at);
      u[axis] = quadratic.of(row.slope, axis);
      v[axis] = cubic.of(row.cross, axis);
    }
    const Floats x = cross_term(u[1], v[2], u[2], v[1]), y = cross_term(u[2], v[0], u[0], v[2]),
                 z = cross_term(u[0], v[1], u[1], v[0]);
    const Floats square = sum_of_squares(x, y, z);
    const Floats lengths = hn::Mul(sum_of_squares(u[0], u[1], u[2]), sum_of_squares(v[0], v[1], v[2]));
    // Where the two directions vanish or coincide there is no normal: the caller looks beside the place.
    const Floats unit = hn::Div(constant(row.sign), hn::Sqrt(square));
    const auto missing = hn::Not(hn::Gt(square, hn::Mul(constant(1e-12f), lengths)));
    const Floats scale = hn::IfThenZeroElse(missing, unit);
    hn::StoreU(hn::Mul(x, scale), kFloats, out.normal[0] + at);
    hn::StoreU(hn::Mul(y, scale), kFloats, out.normal[1] + at);
    hn::StoreU(hn::Mul(z, scale), kFloats, out.normal[2] + at);
    all &= hn::AllFalse(kFloats, hn::And(missing, hn::FirstN(kFloats, static_cast<std::size_t>(last - k))));
  }
  return all;
}

void move(const EyeMap& map, const float (*places)[3], const float (*normals)[3], int count, const Vertices& out) {
  for (int k = 0; k < count; k += kLanes) {
    Floats p[3], n[3], turned[3];
    hn::LoadInterleaved3(kFloats, places[k], p[0], p[1], p[2]);
    hn::LoadInterleaved3(kFloats, normals[k], n[0], n[1], n[2]);
    for (int r = 0; r < 3; ++r) {
      const float* m = map.place[r];
      const float* c = map.normal[r];
      const Floats row[3] = {constant(m[0]), constant(m[1]), constant(m[2])};
      const Floats across[3] = {constant(c[0]), constant(c[1]), constant(c[2])};
      hn::StoreU(hn::Add(product(row, p), constant(m[3])), kFloats, out.place[r] + k);
      turned[r] = product(across, n);
    }
    store_unit(turned, k, out.normal);
  }
}

namespace {

// By which vertices of a skin go.
struct Bent {
  Floats m[3][4];

  // Row r of the cofactors of its linear part times `scale`.
  void cofactors(int r, Floats scale, Floats (&row)[3]) const {
    const Floats(&one)[4] = m[(r + 1) % 3];
    const Floats(&other)[4] = m[(r + 2) % 3];
    for (int c = 0; c < 3; ++c) {
      const int next = (c + 1) % 3, last = (c + 2) % 3;
      row[c] = cross_term(hn::Mul(scale, one[next]), hn::Mul(scale, other[last]), hn::Mul(scale, one[last]),
                          hn::Mul(scale, other[next]));
    }
  }
};

// Visits the bones that any of the vertices from `at` on follows, with their weights.
template <typename Visit>
void visit_bones(const EyeSkin& skin, int count, int at, const Visit& visit) {
  for (int bone = 0; bone < skin.bone_count; ++bone) {
    const Floats weight = hn::LoadU(kFloats, skin.weights + bone * count + at);
    if (!hn::AllTrue(kFloats, hn::Eq(weight, hn::Zero(kFloats)))) visit(bone, weight);
  }
}

Floats times(Floats weight, float number) { return hn::Mul(weight, constant(number)); }

// The sum of bones' matrices times their weights. It begins with 0 and so is never -0: a bone without weight changes
// none of its bits, and vertices that meshlets with different bones share stay the same.
struct LinearBlend : Bent {
  LinearBlend(const EyeSkin& skin, int count, int at) {
    for (auto& row : m)
      for (Floats& number : row) number = hn::Zero(kFloats);
    visit_bones(skin, count, at, [&](int bone, Floats weight) {
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c) m[r][c] = hn::Add(m[r][c], times(weight, skin.bones[bone][r][c]));
    });
  }
};

// As shape::DualBlend<float>, number for number.
struct DualQuaternionBlend : Bent {
  DualQuaternionBlend(const EyeSkin& skin, int count, int at) {
    Floats real[4], dual[4], stretch[3][3];
    for (Floats& number : real) number = hn::Zero(kFloats);
    for (Floats& number : dual) number = hn::Zero(kFloats);
    for (auto& row : stretch)
      for (Floats& number : row) number = hn::Zero(kFloats);
    visit_bones(skin, count, at, [&](int number, Floats weight) {
      const DualBone<float>& bone = skin.duals[number];
      const Floats xy = hn::Add(times(real[0], bone.real[0]), times(real[1], bone.real[1]));
      const Floats along = hn::Add(hn::Add(xy, times(real[2], bone.real[2])), times(real[3], bone.real[3]));
      const Floats turned = hn::IfThenElse(hn::Lt(along, hn::Zero(kFloats)), hn::Neg(weight), weight);
      for (int i = 0; i < 4; ++i) real[i] = hn::Add(real[i], times(turned, bone.real[i]));
      for (int i = 0; i < 4; ++i) dual[i] = hn::Add(dual[i], times(turned, bone.dual[i]));
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) stretch[r][c] = hn::Add(stretch[r][c], times(weight, bone.stretch[r][c]));
    });
    const Floats square = hn::Add(sum_of_squares(real[0], real[1], real[2]), hn::Mul(real[3], real[3]));
    const Floats two = hn::Div(constant(2.0f), square);
    put_linear(real, two, stretch);
    put_place(real, two, dual);
  }

 private:
  void put_linear(const Floats (&real)[4], Floats two, const Floats (&stretch)[3][3]) {
    const Floats one = constant(1.0f);
    const Floats w = real[0], x = real[1], y = real[2], z = real[3];
    const Floats x2 = hn::Mul(x, two), y2 = hn::Mul(y, two), z2 = hn::Mul(z, two);
    const Floats xx = hn::Mul(x, x2), yy = hn::Mul(y, y2), zz = hn::Mul(z, z2), xy = hn::Mul(x, y2),
                 xz = hn::Mul(x, z2), yz = hn::Mul(y, z2), wx = hn::Mul(w, x2), wy = hn::Mul(w, y2),
                 wz = hn::Mul(w, z2);
    const Floats turn[3][3] = {{hn::Sub(one, hn::Add(yy, zz)), hn::Sub(xy, wz), hn::Add(xz, wy)},
                               {hn::Add(xy, wz), hn::Sub(one, hn::Add(xx, zz)), hn::Sub(yz, wx)},
                               {hn::Sub(xz, wy), hn::Add(yz, wx), hn::Sub(one, hn::Add(xx, yy))}};
    for (int c = 0; c < 3; ++c) {
      const Floats column[3] = {stretch[0][c], stretch[1][c], stretch[2][c]};
      for (int r = 0; r < 3; ++r) m[r][c] = product(turn[r], column);
    }
  }

  void put_place(const Floats (&real)[4], Floats two, const Floats (&dual)[4]) {
    for (int r = 0; r < 3; ++r) {
      const int next = 1 + (r + 1) % 3, last = 1 + (r + 2) % 3;
      const Floats straight = cross_term(real[0], dual[1 + r], dual[0], real[1 + r]);
      const Floats across = cross_term(real[next], dual[last], real[last], dual[next]);
      m[r][3] = hn::Mul(hn::Add(straight, across), two);
    }
  }
};

template <typename Blended>
void move_blended(const EyeSkin& skin, const float (*places)[3], const float (*normals)[3], int count,
                  const Vertices& out) {
  const Floats scale = constant(skin.scale);
  for (int k = 0; k < count; k += kLanes) {
    const Blended blended(skin, count, k);
    Floats p[3], n[3], turned[3];
    hn::LoadInterleaved3(kFloats, places[k], p[0], p[1], p[2]);
    hn::LoadInterleaved3(kFloats, normals[k], n[0], n[1], n[2]);
    for (int r = 0; r < 3; ++r) {
      const Floats row[3] = {blended.m[r][0], blended.m[r][1], blended.m[r][2]};
      hn::StoreU(hn::Add(product(row, p), blended.m[r][3]), kFloats, out.place[r] + k);
      Floats across[3];
      blended.cofactors(r, scale, across);
      turned[r] = product(across, n);
    }
    store_unit(turned, k, out.normal);
  }
}

}  // namespace

void move_skin(const EyeSkin& skin, const float (*places)[3], const float (*normals)[3], int count,
               const Vertices& out) {
  if (skin.duals != nullptr) return move_blended<DualQuaternionBlend>(skin, places, normals, count, out);
  move_blended<LinearBlend>(skin, places, normals, count, out);
}

bool project(const Projection& p, const Vertices& v, int count) {
  const Floats guard = constant(p.guard), no_guard = constant(-p.guard), half = constant(0.5f),
               subpixels = constant(kSubpixels);
  const Ints left = hn::Set(kInts, p.origin[0] * kSubpixels), top = hn::Set(kInts, p.origin[1] * kSubpixels);
  bool any = false;
  for (int k = 0; k < count; k += kLanes) {
    const Floats z = hn::LoadU(kFloats, v.place[2] + k), w = hn::Neg(z);
    const Floats inverse = p.parallel ? constant(1.0f) : hn::Div(constant(1.0f), w);
    const Floats dx = hn::Mul(constant(p.scale * p.squeeze), hn::Mul(hn::LoadU(kFloats, v.place[0] + k), inverse));
    const Floats dy = hn::Mul(constant(-p.scale), hn::Mul(hn::LoadU(kFloats, v.place[1] + k), inverse));
    // A NaN is not inside.
    const auto deep = hn::And(hn::Ge(w, constant(p.near)), hn::Le(w, constant(p.far)));
    const auto wide = hn::And(hn::Ge(dx, no_guard), hn::Le(dx, guard));
    const auto high = hn::And(hn::Ge(dy, no_guard), hn::Le(dy, guard));
    const auto inside = hn::And(deep, hn::And(wide, high));
    const Floats x = hn::Add(hn::Mul(hn::Add(constant(p.center[0]), dx), subpixels), half);
    const Floats y = hn::Add(hn::Mul(hn::Add(constant(p.center[1]), dy), subpixels), half);
    const auto snapped = [&](Floats place) {
      return hn::ConvertTo(kInts, hn::Floor(hn::IfThenElseZero(inside, place)));
    };
    hn::StoreU(hn::Sub(snapped(x), left), kInts, v.x + k);
    hn::StoreU(hn::Sub(snapped(y), top), kInts, v.y + k);
    hn::StoreInterleaved4(p.parallel ? z : inverse, hn::Mul(hn::LoadU(kFloats, v.normal[0] + k), inverse),
                          hn::Mul(hn::LoadU(kFloats, v.normal[1] + k), inverse),
                          hn::Mul(hn::LoadU(kFloats, v.normal[2] + k), inverse), kFloats, v.values[k]);
    const auto outside = hn::AndNot(inside, hn::FirstN(kFloats, static_cast<std::size_t>(count - k)));
    std::memset(v.outside + k, 0, kLanes);
    if (hn::AllFalse(kFloats, outside)) continue;
    any = true;
    float flags[kLanes];
    hn::StoreU(hn::IfThenElseZero(outside, constant(1.0f)), kFloats, flags);
    for (int lane = 0; lane < kLanes; ++lane) v.outside[k + lane] = flags[lane] != 0.0f;
  }
  return any;
}

}  // namespace mars::shape::MARS_SET
