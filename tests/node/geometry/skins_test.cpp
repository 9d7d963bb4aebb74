// Skins in eye space: vertices by the formula, in single precision bit for bit from every instruction set; as a rigid
// mesh where there is one bone; the same in all meshlets that share them; and always within their bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "node/geometry/meshlets.h"
#include "tests/node/shape/patches.h"
#include "tests/node/simd/instruction_sets.h"
#include "tests/node/wire/small_film.h"

namespace mars::geometry {
namespace {

using Float3 = std::array<float, 3>;

constexpr shape::Projection kSeen{500, {160, 90}, 0.1f, 100, 32768, 0.9f};
constexpr std::uint32_t kVertices = 45;

wire::Matrix random_bone(shape::Random& random, double scale) {
  wire::Matrix matrix;
  for (auto& row : matrix.m)
    for (double& number : row) number = random.real(-1, 1) * scale;
  matrix.m[2][3] -= 3 * scale;
  return matrix;
}

// A film with one segment: a meshlet of random vertices that follow 1 to 4 of `bones` bones.
class OneSkin {
 public:
  OneSkin(shape::Random& random, std::uint32_t bones, double scale = 1) {
    wire::FilmData film = wire::small_film();
    film.segments.resize(1);
    film.segments[0] = {0, 0, {0, 1}, {0, 1}, 0, 0, bones};
    film.shapes = {{0, static_cast<std::uint32_t>(film.patches.size()), 0, 1, bones}};
    film.net_points.clear(), film.stencil_terms.clear(), film.stencils.clear(), film.net_patches.clear();
    film.intervals = {{0, 3, 0, 0}};
    film.mesh_places.clear(), film.mesh_normals.clear();
    film.skin_bones.clear(), film.bones.clear();
    wire::Meshlet meshlet{0, kVertices, 0, 1, {1, 1, 1}, {0, 0, 0}, {0, bones, 0}};
    for (std::uint32_t v = 0; v < kVertices; ++v) {
      Float3 place, normal;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        place[axis] = static_cast<float>(random.real(0, 1));
        normal[axis] = static_cast<float>(random.real(-1, 1));
        meshlet.low[axis] = std::min(meshlet.low[axis], place[axis]);
        meshlet.high[axis] = std::max(meshlet.high[axis], place[axis]);
      }
      film.mesh_places.push_back(place);
      film.mesh_normals.push_back(normal);
    }
    film.mesh_triangles = {{0, 1, 2}};
    film.meshlets = {meshlet};
    film.skin_weights.clear();
    add_weights(random, kVertices, bones, film.skin_weights);
    for (std::size_t patch = 0; patch < film.patches.size(); ++patch) add_net_patch(random, bones, film);
    for (std::uint32_t bone = 0; bone < bones; ++bone) {
      film.skin_bones.push_back(bone);
      film.bones.push_back({static_cast<std::uint32_t>(film.changes.size()), 1});
      film.changes.push_back({0, static_cast<std::uint32_t>(film.matrices.size())});
      film.matrices.push_back(random_bone(random, scale));
    }
    block_ = wire::pack(film);
  }

  wire::PackedFilm view() const { return {block_, "film"}; }

 private:
  // Of sixteen points of its own: every other is one of them, the others are means of two.
  static void add_net_patch(shape::Random& random, std::uint32_t bones, wire::FilmData& film) {
    wire::NetPatch& patch = film.net_patches.emplace_back();
    const auto first = static_cast<std::uint32_t>(film.net_points.size());
    for (std::uint32_t i = 0; i < wire::kPatchPoints; ++i) {
      wire::NetPoint point{{}, {0, bones, static_cast<std::uint32_t>(film.skin_weights.size())}};
      for (float& coordinate : point.place) coordinate = static_cast<float>(random.real(0, 1));
      film.net_points.push_back(point);
      add_weights(random, 1, bones, film.skin_weights);
      patch[i] = static_cast<std::uint32_t>(film.stencils.size());
      const auto term = static_cast<std::uint32_t>(film.stencil_terms.size());
      if (i % 2 == 0) {
        film.stencils.push_back({term, 1});
        film.stencil_terms.push_back({first + i, 1});
      } else {
        film.stencils.push_back({term, 2});
        film.stencil_terms.insert(film.stencil_terms.end(), {{first + i - 1, 0.3f}, {first + i, 0.7f}});
      }
    }
  }

  // Bone by bone, of `points` points.
  static void add_weights(shape::Random& random, std::uint32_t points, std::uint32_t bones,
                          std::vector<float>& weights) {
    const std::size_t begin = weights.size();
    weights.resize(begin + std::size_t{points} * bones, 0);
    for (std::uint32_t point = 0; point < points; ++point) {
      const auto count = std::min<std::uint32_t>(bones, static_cast<std::uint32_t>(random.whole(1, 4)));
      std::vector<double> parts;
      double sum = 0;
      for (std::uint32_t i = 0; i < count; ++i) sum += parts.emplace_back(random.real(0.1, 1));
      const auto first = static_cast<std::uint32_t>(random.whole(0, static_cast<std::int32_t>(bones - count)));
      for (std::uint32_t i = 0; i < count; ++i)
        weights[begin + (first + i) * points + point] = static_cast<float>(parts[i] / sum);
    }
  }

  std::vector<std::byte> block_;
};

struct Placed {
  Scene scene;
  SegmentPlace place;

  explicit Placed(const wire::PackedFilm& film) : scene(film) { place.find(scene, 0); }
};

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
          for (const wire::StencilTerm& term : film.terms_of(film.stencils()[film.net_patches()[number][point]]))
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

float lowest(const BoxCorners& corners, int axis) {
  float low = corners.point[0][axis];
  for (const auto& point : corners.point) low = std::min(low, point[axis]);
  return low;
}

float highest(const BoxCorners& corners, int axis) {
  float high = corners.point[0][axis];
  for (const auto& point : corners.point) high = std::max(high, point[axis]);
  return high;
}

TEST(Skins, StayWithinTheirBounds) {
  shape::Random random(5);
  MeshletPlacer placer(simd::best_instruction_set(""));
  double widest = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const OneSkin skin(random, static_cast<std::uint32_t>(random.whole(1, 8)), std::pow(10, random.real(-4, 4)));
    const wire::PackedFilm film = skin.view();
    const Placed placed(film);
    placer.place(placed.place, film, film.meshlets()[0], kSeen);
    const BoxCorners of_meshlet = placed.place.corners(film, film.meshlets()[0]),
                     of_shape = placed.place.corners(ShapeBoxes(film));
    for (int axis = 0; axis < 3; ++axis) {
      const float* const places = placer.vertices().place[axis];
      const auto [least, most] = std::minmax_element(places, places + kVertices);
      for (std::size_t number = 0; number < film.patches().size(); ++number)
        for (const auto& point : placed.place.patch(film, number).point) {
          ASSERT_LE(lowest(of_shape, axis), point[axis]) << "trial " << trial;
          ASSERT_GE(highest(of_shape, axis), point[axis]) << "trial " << trial;
        }
      for (const BoxCorners& corners : {of_meshlet, of_shape}) {
        const float low = lowest(corners, axis), high = highest(corners, axis);
        ASSERT_LE(low, *least) << "trial " << trial;
        ASSERT_GE(high, *most) << "trial " << trial;
        widest = std::max(widest, double{high - low} / (*most - *least));
      }
    }
  }
  EXPECT_LT(widest, 60);
}

}  // namespace
}  // namespace mars::geometry
