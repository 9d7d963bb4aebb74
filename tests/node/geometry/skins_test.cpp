// Skins in eye space: vertices by the formula, in single precision bit for bit from every instruction set; as a rigid
// mesh where there is one bone; the same in all meshlets that share them; and always within their bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "node/geometry/meshlets.h"
#include "tests/node/geometry/one_skin.h"
#include "tests/node/simd/instruction_sets.h"

namespace mars::geometry {
namespace {

using Float3 = std::array<float, 3>;

// The sum of the bones that a vertex follows, in the order of the kernel.
template <typename Number>
std::array<std::array<Number, 4>, 3> blended(const wire::PackedFilm& film, const SegmentPlace& place,
                                             std::uint32_t vertex) {
  std::array<std::array<Number, 4>, 3> sum{};
  for (std::size_t bone = 0; bone < place.bones().size(); ++bone)
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 4; ++c)
        sum[r][c] += Number{film.skin_weights()[bone * kVertices + vertex]} * Number{place.bones()[bone].m[r][c]};
  return sum;
}

// Of a patch's points, as plainly as can be.
TEST(Skins, PatchesPointsAreMeansOfTheSumsBitForBit) {
  shape::Random random(6);
  for (const std::uint32_t bones : {1u, 3u, 9u}) {
    const OneSkin skin(random, bones);
    const wire::PackedFilm film = skin.view();
    const Placed placed(film);
    const auto moved_by_bones = [&](const wire::NetPoint& point, std::size_t r) {
      float m[4] = {};
      for (std::size_t bone = 0; bone < bones; ++bone)
        for (std::size_t c = 0; c < 4; ++c)
          m[c] += film.skin_weights()[point.skin.first_weight + bone] * placed.place.bones()[bone].m[r][c];
      const Float3& p = point.place;
      return ((m[0] * p[0] + m[1] * p[1]) + m[2] * p[2]) + m[3];
    };
    for (std::size_t number = 0; number < film.patches().size(); ++number) {
      const shape::EyePatch moved = placed.place.patch(film, number);
      for (std::size_t point = 0; point < wire::kPatchPoints; ++point)
        for (std::size_t r = 0; r < 3; ++r) {
          float expected = 0;
          for (const wire::StencilTerm& term :
               film.terms_of(film.stencils()[film.net_patches()[number].stencils[point]]))
            expected += term.weight * moved_by_bones(film.net_points()[term.point], r);
          ASSERT_EQ(std::memcmp(&moved.point[point][r], &expected, sizeof(float)), 0) << bones << " bones";
        }
    }
  }
}

TEST(Skins, PlacesAreTheSumsBitForBit) {
  shape::Random random(1);
  for (const simd::InstructionSet set : simd::all_sets()) {
    MeshletPlacer placer(set);
    for (const std::uint32_t bones : {1u, 2u, 5u, wire::kMeshletBones}) {
      const OneSkin skin(random, bones);
      const wire::PackedFilm film = skin.view();
      const Placed placed(film);
      placer.place(placed.place, film, film.meshlets()[0], kSeen);
      for (std::uint32_t v = 0; v < kVertices; ++v) {
        const auto m = blended<float>(film, placed.place, v);
        const Float3& p = film.mesh_places()[v];
        for (std::size_t r = 0; r < 3; ++r) {
          const float expected = ((m[r][0] * p[0] + m[r][1] * p[1]) + m[r][2] * p[2]) + m[r][3];
          ASSERT_EQ(std::memcmp(&placer.vertices().place[r][v], &expected, sizeof(float)), 0) << simd::name_of(set);
        }
      }
    }
  }
}

TEST(Skins, EveryInstructionSetGivesTheSameNormals) {
  shape::Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const OneSkin skin(random, 6, std::pow(10, random.real(-6, 6)));
    const wire::PackedFilm film = skin.view();
    const Placed placed(film);
    MeshletPlacer plain(simd::all_sets().front());
    plain.place(placed.place, film, film.meshlets()[0], kSeen);
    for (const simd::InstructionSet set : simd::all_sets()) {
      MeshletPlacer placer(set);
      placer.place(placed.place, film, film.meshlets()[0], kSeen);
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(std::memcmp(placer.vertices().normal[axis], plain.vertices().normal[axis], kVertices * sizeof(float)),
                  0)
            << simd::name_of(set);
    }
  }
}

// By the cofactors of the sum, in doubles.
TEST(Skins, NormalsFollowTheSum) {
  shape::Random random(3);
  MeshletPlacer placer(simd::best_instruction_set(""));
  for (int trial = 0; trial < 100; ++trial) {
    const OneSkin skin(random, 4, std::pow(10, random.real(-5, 5)));
    const wire::PackedFilm film = skin.view();
    const Placed placed(film);
    placer.place(placed.place, film, film.meshlets()[0], kSeen);
    for (std::uint32_t v = 0; v < kVertices; ++v) {
      const auto m = blended<double>(film, placed.place, v);
      double turned[3], length = 0, size = 0;
      for (std::size_t r = 0; r < 3; ++r) {
        turned[r] = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          const auto &one = m[(r + 1) % 3], &other = m[(r + 2) % 3];
          const double cofactor = one[(c + 1) % 3] * other[(c + 2) % 3] - one[(c + 2) % 3] * other[(c + 1) % 3];
          turned[r] += cofactor * film.mesh_normals()[v][c];
          size = std::max(size, std::abs(cofactor));
        }
        length += turned[r] * turned[r];
      }
      length = std::sqrt(length);
      if (length < 0.01 * size) continue;  // what is flattened has no sure normal
      for (std::size_t r = 0; r < 3; ++r)
        EXPECT_NEAR(placer.vertices().normal[r][v], turned[r] / length, 1e-3) << "trial " << trial;
    }
  }
}

TEST(Skins, OfOneBoneStandAsARigidMesh) {
  shape::Random random(4);
  const OneSkin skin(random, 1);
  const wire::PackedFilm film = skin.view();
  const Placed placed(film);
  MeshletPlacer bent(simd::best_instruction_set("")), rigid(simd::best_instruction_set(""));
  bent.place(placed.place, film, film.meshlets()[0], kSeen);
  rigid.place(eye_map(placed.place.bones()[0]), film, film.meshlets()[0], kSeen);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(std::memcmp(bent.vertices().place[axis], rigid.vertices().place[axis], kVertices * sizeof(float)), 0);
    for (std::uint32_t v = 0; v < kVertices; ++v)
      EXPECT_NEAR(bent.vertices().normal[axis][v], rigid.vertices().normal[axis][v], 1e-4);
  }
}

TEST(Skins, StayWithinTheirBounds) {
  shape::Random random(5);
  double widest = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const OneSkin skin(random, static_cast<std::uint32_t>(random.whole(1, 8)), std::pow(10, random.real(-4, 4)));
    widest = std::max(widest, expect_within_bounds(skin.view(), "trial " + std::to_string(trial)));
  }
  EXPECT_LT(widest, 60);
}

}  // namespace
}  // namespace mars::geometry
