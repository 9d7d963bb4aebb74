// Skins whose bones are blended by dual quaternions: by the formula of Kavan et al., number for number as the plain
// twin from every instruction set, within their bounds however far bones turn, and full where linear blending pinches.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "node/geometry/meshlets.h"
#include "node/shape/dual_quaternion.h"
#include "tests/node/geometry/one_skin.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::geometry {
namespace {

constexpr wire::Blend kDual = wire::Blend::dual_quaternions;
constexpr double kPi = std::numbers::pi;

using Vec3 = shape::Vec3;

struct Quaternion {
  double w;
  Vec3 v;
};

Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  const Vec3 across = shape::cross(a.v, b.v);
  Quaternion out{a.w * b.w - shape::dot(a.v, b.v), {}};
  for (std::size_t i = 0; i < 3; ++i) out.v[i] = a.w * b.v[i] + b.w * a.v[i] + across[i];
  return out;
}

Vec3 unit(const Vec3& v) { return {v[0] / shape::length(v), v[1] / shape::length(v), v[2] / shape::length(v)}; }

// As it is made: first scaled along its axes, then turned, then put to a place.
struct TestBone {
  Vec3 scale;
  Quaternion turn;
  Vec3 place;

  Vec3 turned(const Vec3& p) const {
    return (turn * Quaternion{0, p} * Quaternion{turn.w, {-turn.v[0], -turn.v[1], -turn.v[2]}}).v;
  }
  wire::Matrix matrix() const {
    wire::Matrix m;
    for (std::size_t c = 0; c < 3; ++c) {
      Vec3 axis{};
      axis[c] = scale[c];
      const Vec3 column = turned(axis);
      for (std::size_t r = 0; r < 3; ++r) m.m[r][c] = column[r];
    }
    for (std::size_t r = 0; r < 3; ++r) m.m[r][3] = place[r];
    return m;
  }
};

Vec3 random_vector(shape::Random& random, double size) {
  return {random.real(-size, size), random.real(-size, size), random.real(-size, size)};
}

TestBone turned_by(double angle, const Vec3& axis, const Vec3& place, const Vec3& scale = {1, 1, 1}) {
  const double s = std::sin(angle / 2);
  return {scale, {std::cos(angle / 2), {axis[0] * s, axis[1] * s, axis[2] * s}}, place};
}

// `most`: how far one turns against the one before, in radians.
std::vector<TestBone> random_chain(shape::Random& random, std::uint32_t bones, double most) {
  std::vector<TestBone> chain;
  Quaternion turn = turned_by(random.real(-3, 3), unit(random_vector(random, 1)), {}).turn;
  for (std::uint32_t bone = 0; bone < bones; ++bone) {
    const Vec3 place = random_vector(random, 1), scale{random.real(0.1, 2), random.real(0.1, 2), random.real(0.1, 2)};
    chain.push_back(
        {random.whole(0, 2) == 0 || bone == 0 ? scale : chain[0].scale, turn, {place[0], place[1], place[2] - 5}});
    turn = turned_by(random.real(-most, most), unit(random_vector(random, 1)), {}).turn * turn;
  }
  return chain;
}

std::vector<wire::Matrix> matrices_of(const std::vector<TestBone>& bones) {
  std::vector<wire::Matrix> matrices;
  for (const TestBone& bone : bones) matrices.push_back(bone.matrix());
  return matrices;
}

// By the formula, in doubles; quaternions on the side of the sum before them.
Vec3 by_formula(const std::vector<TestBone>& bones, const std::vector<double>& weights, const Vec3& at) {
  Quaternion real{}, dual{};
  Vec3 scaled{};
  for (std::size_t bone = 0; bone < bones.size(); ++bone) {
    const TestBone& b = bones[bone];
    const double side = real.w * b.turn.w + shape::dot(real.v, b.turn.v) < 0 ? -1 : 1, weight = side * weights[bone];
    const Quaternion half = Quaternion{0, b.place} * b.turn;
    real.w += weight * b.turn.w, dual.w += 0.5 * weight * half.w;
    for (std::size_t i = 0; i < 3; ++i) {
      real.v[i] += weight * b.turn.v[i];
      dual.v[i] += 0.5 * weight * half.v[i];
      scaled[i] += weights[bone] * b.scale[i] * at[i];
    }
  }
  const double length = std::sqrt(real.w * real.w + shape::dot(real.v, real.v));
  const Quaternion back{real.w / length, {-real.v[0] / length, -real.v[1] / length, -real.v[2] / length}};
  const Vec3 turned =
      (Quaternion{real.w / length, {-back.v[0], -back.v[1], -back.v[2]}} * Quaternion{0, scaled} * back).v;
  const Vec3 place = (dual * back).v;
  Vec3 out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = turned[i] + 2 * place[i] / length;
  return out;
}

std::vector<double> weights_of(const wire::PackedFilm& film, std::uint32_t vertex) {
  std::vector<double> weights;
  for (std::size_t bone = 0; bone < film.bones().size(); ++bone)
    weights.push_back(film.skin_weights()[bone * kVertices + vertex]);
  return weights;
}

TEST(DualSkins, PlacesAreByTheFormula) {
  shape::Random random(1);
  MeshletPlacer placer(simd::best_instruction_set(""));
  for (int trial = 0; trial < 100; ++trial) {
    const auto bones = random_chain(random, static_cast<std::uint32_t>(random.whole(1, 6)), 2.9);
    const OneSkin skin(random, matrices_of(bones), kDual);
    const wire::PackedFilm film = skin.view();
    const Placed placed(film);
    placer.place(placed.place, film, film.meshlets()[0], kSeen);
    for (std::uint32_t v = 0; v < kVertices; ++v) {
      const auto& at = film.mesh_places()[v];
      const Vec3 expected = by_formula(bones, weights_of(film, v), {at[0], at[1], at[2]});
      for (std::size_t r = 0; r < 3; ++r)
        EXPECT_NEAR(placer.vertices().place[r][v], expected[r], 1e-5) << "trial " << trial;
    }
  }
}

// The plain twin is what moves patches' points.
TEST(DualSkins, AreThePlainTwinsBitsFromEveryInstructionSet) {
  shape::Random random(2);
  for (const simd::InstructionSet set : simd::all_sets()) {
    MeshletPlacer placer(set), plain(simd::all_sets().front());
    for (const std::uint32_t bones : {1u, 2u, 5u, wire::kMeshletBones}) {
      const OneSkin skin(random, matrices_of(random_chain(random, bones, 3)), kDual);
      const wire::PackedFilm film = skin.view();
      const Placed placed(film);
      EyeBones eye;
      eye.begin(kDual, bones);
      for (std::uint32_t bone = 0; bone < bones; ++bone) eye.put(bone, placed.place.bones()[bone]);
      placer.place(placed.place, film, film.meshlets()[0], kSeen);
      plain.place(placed.place, film, film.meshlets()[0], kSeen);
      for (std::uint32_t v = 0; v < kVertices; ++v) {
        float expected[3];
        shape::to_eye(blended(film, film.meshlets()[0].skin, v, kVertices, eye), film.mesh_places()[v], expected);
        for (std::size_t r = 0; r < 3; ++r)
          ASSERT_EQ(std::memcmp(&placer.vertices().place[r][v], &expected[r], sizeof(float)), 0) << simd::name_of(set);
      }
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(std::memcmp(placer.vertices().normal[axis], plain.vertices().normal[axis], kVertices * sizeof(float)),
                  0)
            << simd::name_of(set);
    }
  }
}

// Whichever of a turn's two quaternions a bone has, and whatever bones without weight stand between.
TEST(DualSkins, SharedPointsKeepTheirBits) {
  shape::Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    shape::DualBlend<float> few, many;
    for (const TestBone& bone : random_chain(random, 3, 3)) {
      shape::DualBone<float> dual = shape::rounded(shape::dual_bone(shape::parts_of(bone.matrix())));
      const auto weight = static_cast<float>(random.real(0.1, 1));
      few.add(dual, weight);
      for (float& number : dual.real) number = -number;
      for (float& number : dual.dual) number = -number;
      many.add(shape::rounded(shape::dual_bone(shape::parts_of(random_chain(random, 1, 3)[0].matrix()))), 0);
      many.add(dual, weight);
    }
    shape::EyeMatrix one, other;
    few.put(one.m);
    many.put(other.m);
    ASSERT_EQ(std::memcmp(&one, &other, sizeof one), 0) << "trial " << trial;
  }
}

// Whatever a matrix is, sheared or a mirror: alone it moves what follows it as it is.
TEST(DualSkins, BonesAloneAreTheirMatrices) {
  shape::Random random(4);
  for (int trial = 0; trial < 1000; ++trial) {
    const wire::Matrix matrix = random_bone(random, std::pow(10, random.real(-5, 5)));
    shape::DualBlend<double> blend;
    blend.add(shape::dual_bone(shape::parts_of(matrix)), 1);
    wire::Matrix out;
    blend.put(out.m);
    double size = 0;
    for (const auto& row : matrix.m)
      for (const double number : row) size = std::max(size, std::abs(number));
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(out.m[r][c], matrix.m[r][c], 1e-13 * size) << "trial " << trial;
  }
}

TEST(DualSkins, TurnsNearHalfACircleAreFound) {
  for (const double angle : {kPi, kPi - 1e-9, kPi + 1e-7, -kPi, 3.0, 1e-9})
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, unit({1, 1, 1}), unit({1, -2, 0.1})}) {
      const TestBone bone = turned_by(angle, axis, {1, 2, 3}, {0.1, 5, 1});
      const shape::DualBone<double> dual = shape::dual_bone(shape::parts_of(bone.matrix()));
      const double same = dual.real[0] * bone.turn.w + dual.real[1] * bone.turn.v[0] + dual.real[2] * bone.turn.v[1] +
                          dual.real[3] * bone.turn.v[2];
      EXPECT_NEAR(std::abs(same), 1, 1e-14) << angle;
    }
}

TEST(DualSkins, FlatBonesAreFiniteAndKnown) {
  const wire::Matrix nothing{}, flat{{{{1, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}}}};
  const wire::Matrix tiny{{{{1e-200, 0, 0, 0}, {0, 1e-200, 0, 0}, {0, 0, 1e12, 0}}}};
  EXPECT_TRUE(shape::is_flat(nothing));
  EXPECT_TRUE(shape::is_flat(flat));
  EXPECT_FALSE(shape::is_flat(tiny));
  for (const wire::Matrix& matrix : {nothing, flat, tiny}) {
    shape::DualBlend<float> blend;
    blend.add(shape::rounded(shape::dual_bone(shape::parts_of(matrix))), 1);
    shape::EyeMatrix out;
    blend.put(out.m);
    for (const auto& row : out.m)
      for (const float number : row) EXPECT_TRUE(std::isfinite(number));
  }
}

TEST(DualSkins, StayWithinTheirBounds) {
  shape::Random random(5);
  for (int trial = 0; trial < 400; ++trial) {
    const auto count = static_cast<std::uint32_t>(random.whole(1, 8));
    std::vector<wire::Matrix> bones = matrices_of(random_chain(random, count, trial % 4 == 0 ? kPi : 1.5));
    if (trial % 8 == 1)
      for (wire::Matrix& bone : bones) bone = random_bone(random, 1);
    expect_within_bounds(OneSkin(random, bones, kDual).view(), "trial " + std::to_string(trial));
  }
}

// Boxes that are points, so that only what is beyond the bones' own places makes room.
TEST(DualSkins, PointsStayWithinTheirBounds) {
  shape::Random random(6);
  for (int trial = 0; trial < 20000; ++trial) {
    const auto count = static_cast<std::uint32_t>(random.whole(2, 4));
    SkinBounds bounds;
    bounds.begin(kDual, count);
    shape::DualBlend<double> blend;
    double sum = 0;
    std::vector<double> weights;
    std::vector<std::uint32_t> numbers;
    const std::vector<TestBone> bones = random_chain(random, count, kPi);
    for (std::uint32_t bone = 0; bone < count; ++bone) {
      bounds.add(bones[bone].matrix());
      numbers.push_back(bone);
      sum += weights.emplace_back(trial % 3 == 0 ? 1 : random.real(0, 1));
    }
    for (std::uint32_t bone = 0; bone < count; ++bone)
      blend.add(shape::dual_bone(shape::parts_of(bones[bone].matrix())), weights[bone] / sum);
    wire::Matrix m;
    blend.put(m.m);
    const std::array<float, 3> at{float(random.real(0, 1)), float(random.real(0, 1)), float(random.real(0, 1))};
    const SkinBounds::Box box = bounds.round(numbers, at, at);
    for (std::size_t r = 0; r < 3; ++r) {
      const double place = m.m[r][0] * at[0] + m.m[r][1] * at[1] + m.m[r][2] * at[2] + m.m[r][3];
      ASSERT_TRUE(box.low[r] <= place && place <= box.high[r]) << "trial " << trial;
    }
  }
}

// Two bones that meet in a hinge, as a knee does: a limb of radius 0.5 round the z axis, cut at z = 0.
std::vector<TestBone> hinge(double angle) {
  return {turned_by(0, {1, 0, 0}, {0, 0, -5}), turned_by(angle, {1, 0, 0}, {0, 0, -5})};
}

// Half of the joint's ring follows either bone alike. Linear blending pulls it to the hinge by the cosine of half the
// angle; round an arc it keeps its distance.
TEST(DualSkins, BentKneesKeepTheirVolume) {
  const std::vector<TestBone> bones = hinge(150 * kPi / 180);
  EyeBones dual, linear;
  dual.begin(kDual, 2);
  linear.begin(wire::Blend::linear, 2);
  shape::DualBlend<double> turned;
  wire::Matrix sum{};
  for (const TestBone& bone : bones) {
    turned.add(shape::dual_bone(shape::parts_of(bone.matrix())), 0.5);
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 4; ++c) sum.m[r][c] += 0.5 * bone.matrix().m[r][c];
  }
  wire::Matrix by_dual;
  turned.put(by_dual.m);
  const auto height = [](const wire::Matrix& m) { return std::hypot(m.m[1][1] * 0.5, m.m[2][1] * 0.5); };
  EXPECT_NEAR(height(by_dual), 0.5, 1e-12);
  EXPECT_NEAR(height(sum), 0.5 * std::cos(75 * kPi / 180), 1e-12);
}

// Round a hinge that bends by 150 degrees the box is no wider than the arc's height over its chord.
TEST(DualSkins, BoundsOfAHingeAreTight) {
  SkinBounds bounds;
  bounds.begin(kDual, 2);
  for (const TestBone& bone : hinge(150 * kPi / 180)) bounds.add(bone.matrix());
  const std::vector<std::uint32_t> both = {0, 1};
  const SkinBounds::Box box = bounds.round(both, {0, 0.5f, 0}, {0, 0.5f, 0});
  const double chord = 2 * 0.5 * std::sin(75 * kPi / 180), arc = 0.5 - 0.5 * std::cos(75 * kPi / 180);
  EXPECT_NEAR(box.high[0], arc, 1e-3);
  EXPECT_NEAR(box.high[1] - box.low[1], 0.5 * (1 - std::cos(150 * kPi / 180)) + 2 * arc, 1e-3);
  EXPECT_GT(chord, arc);
}

}  // namespace
}  // namespace mars::geometry
