// Meshlets placed in eye space: places and normals by the formulas, bit for bit from every instruction set, however the
// matrix stretches, shears or mirrors; and those outside the picture dropped, no others.
#include "node/geometry/meshlets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "tests/node/raster/plain_set_up.h"
#include "tests/node/raster/set_ups.h"
#include "tests/node/shape/patches.h"
#include "tests/node/simd/instruction_sets.h"
#include "tests/node/wire/small_film.h"

namespace mars::geometry {

using shape::operator-;

namespace {

using shape::EyeMatrix;
using Float3 = std::array<float, 3>;

constexpr shape::Projection kView{500, {160, 90}, 0.1f, 100, 32768, 0.9f};

// A film with one meshlet of random triangles, the normals of each corner its triangle's.
class OneMeshlet {
 public:
  OneMeshlet(shape::Random& random, std::uint32_t triangles) {
    wire::FilmData film = wire::small_film();
    film.mesh_places.clear();
    film.mesh_normals.clear();
    film.mesh_triangles.clear();
    wire::Meshlet meshlet{0, 3 * triangles, 0, triangles, {1, 1, 1}, {0, 0, 0}};
    for (std::uint32_t t = 0; t < triangles; ++t) {
      for (std::uint8_t k = 0; k < 3; ++k) {
        Float3 place;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          place[axis] = static_cast<float>(random.real(0, 1));
          meshlet.low[axis] = std::min(meshlet.low[axis], place[axis]);
          meshlet.high[axis] = std::max(meshlet.high[axis], place[axis]);
        }
        film.mesh_places.push_back(place);
      }
      const auto normal = cross(film.mesh_places.end()[-3], film.mesh_places.end()[-2], film.mesh_places.end()[-1]);
      film.mesh_normals.insert(film.mesh_normals.end(), 3, {float(normal[0]), float(normal[1]), float(normal[2])});
      const auto first = static_cast<std::uint8_t>(3 * t);
      film.mesh_triangles.push_back(
          {first, static_cast<std::uint8_t>(first + 1), static_cast<std::uint8_t>(first + 2)});
    }
    film.meshlets = {meshlet};
    film.shapes[1].meshlet_count = 1;
    film.shapes[2].first_meshlet = film.shapes[2].meshlet_count = 0;
    block_ = wire::pack(film);
  }

  wire::PackedFilm view() const { return {block_, "film"}; }

  // (b - a) x (c - a)
  template <typename Place>
  static std::array<double, 3> cross(const Place& a, const Place& b, const Place& c) {
    std::array<double, 3> out;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
      out[axis] = (double{b[y]} - a[y]) * (double{c[z]} - a[z]) - (double{b[z]} - a[z]) * (double{c[y]} - a[y]);
    }
    return out;
  }

 private:
  std::vector<std::byte> block_;
};

EyeMatrix random_matrix(shape::Random& random, double scale) {
  EyeMatrix matrix;
  for (auto& row : matrix.m)
    for (float& number : row) number = static_cast<float>(random.real(-1, 1) * scale);
  matrix.m[2][3] -= static_cast<float>(3 * scale);
  return matrix;
}

TEST(Meshlets, PlacesAreThoseOfAPatchsPointsBitForBit) {
  shape::Random random(1);
  for (const simd::InstructionSet set : simd::all_sets()) {
    MeshletPlacer placer(set);
    for (const std::uint32_t triangles : {1u, 5u, 6u, 64u}) {
      const OneMeshlet mesh(random, triangles);
      const wire::PackedFilm film = mesh.view();
      const EyeMatrix matrix = random_matrix(random, 1);
      placer.place(eye_map(matrix), film, film.meshlets()[0], kView);
      ASSERT_EQ(placer.vertex_count(), static_cast<int>(3 * triangles));
      ASSERT_EQ(placer.triangles().count, triangles);
      for (std::size_t k = 0; k < 3 * triangles; ++k) {
        float expected[3];
        shape::to_eye(matrix, film.mesh_places()[k], expected);
        for (int axis = 0; axis < 3; ++axis)
          ASSERT_EQ(std::memcmp(&placer.vertices().place[axis][k], &expected[axis], sizeof(float)), 0)
              << simd::name_of(set);
      }
    }
  }
}

TEST(Meshlets, EveryInstructionSetGivesTheSameNormals) {
  shape::Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const OneMeshlet mesh(random, 21);
    const wire::PackedFilm film = mesh.view();
    const shape::EyeMap map = eye_map(random_matrix(random, std::pow(10, random.real(-6, 6))));
    MeshletPlacer plain(simd::all_sets().front());
    plain.place(map, film, film.meshlets()[0], kView);
    for (const simd::InstructionSet set : simd::all_sets()) {
      MeshletPlacer placer(set);
      placer.place(map, film, film.meshlets()[0], kView);
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(std::memcmp(placer.vertices().normal[axis], plain.vertices().normal[axis], 63 * sizeof(float)), 0)
            << simd::name_of(set);
    }
  }
}

// A flat triangle's normal stays at right angles to it, on the side from which its corners run counter-clockwise.
TEST(Meshlets, NormalsFollowTheirSurfaceThroughStretchShearAndMirror) {
  shape::Random random(3);
  int mirrored = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const OneMeshlet mesh(random, 8);
    const wire::PackedFilm film = mesh.view();
    const EyeMatrix matrix = random_matrix(random, std::pow(10, random.real(-5, 5)));
    mirrored += shape::mirrors(matrix);
    MeshletPlacer placer(simd::best_instruction_set(""));
    placer.place(eye_map(matrix), film, film.meshlets()[0], kView);
    const shape::Vertices& v = placer.vertices();
    const auto place = [&](std::size_t k) { return Float3{v.place[0][k], v.place[1][k], v.place[2][k]}; };
    for (std::size_t k = 0; k < 24; k += 3) {
      const auto right = OneMeshlet::cross(place(k), place(k + 1), place(k + 2));
      double along = 0, length = 0, square = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        along += right[axis] * v.normal[axis][k];
        length += right[axis] * right[axis];
        square += double{v.normal[axis][k]} * v.normal[axis][k];
      }
      EXPECT_NEAR(square, 1, 1e-5);
      EXPECT_GT(along, 0.98 * std::sqrt(length)) << "trial " << trial;
    }
  }
  EXPECT_GT(mirrored, 50);
}

TEST(Meshlets, WithoutANormalThereIsNone) {
  wire::FilmData data = wire::small_film();
  data.mesh_normals.assign(7, {0, 0, 0});
  const auto block = wire::pack(data);
  const wire::PackedFilm film(block, "film");
  MeshletPlacer placer(simd::best_instruction_set(""));
  for (const float scale : {1.0f, 0.0f}) {
    const EyeMatrix matrix{{{scale, 0, 0, 0}, {0, scale, 0, 0}, {0, 0, scale, -5}}};
    placer.place(eye_map(matrix), film, film.meshlets()[0], kView);
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(placer.vertices().normal[axis][0], 0);
  }
}

// A dropped meshlet would leave no mark, by the plain twin; and most of those without a mark are dropped.
TEST(Meshlets, OnlyTheUnseenAreDropped) {
  shape::Random random(4);
  const raster::PatchIdentity identity{0, 0, false, false, false};
  int dropped = 0, seen = 0, idle = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const OneMeshlet mesh(random, 2);
    const wire::PackedFilm film = mesh.view();
    EyeMatrix matrix = random_matrix(random, std::pow(10, random.real(-1, 1)));
    matrix.m[0][3] += static_cast<float>(random.real(-3, 3));
    matrix.m[2][3] += static_cast<float>(random.real(-3, 3));
    MeshletPlacer placer(simd::best_instruction_set(""));
    placer.place(eye_map(matrix), film, film.meshlets()[0], kView);
    std::size_t boxes = 0;
    for (const raster::PlainTriangle& t : raster::plain_set_up(placer, kView, identity))
      boxes += raster::plain_edge_boxes(t.corners, 320, 180, shape::sample_pattern(1)).size();
    const BoxCorners corners = corners_of(matrix, film.meshlets()[0].low, film.meshlets()[0].high);
    const bool unseen = shape::unseen(corners.point, BoxCorners::kCount, kView, 320, 180);
    EXPECT_TRUE(!unseen || boxes == 0) << "trial " << trial;
    dropped += unseen;
    seen += boxes > 0;
    idle += !unseen && boxes == 0;
  }
  EXPECT_GT(dropped, 200);
  EXPECT_GT(seen, 200);
  EXPECT_LT(idle, dropped);
}

// Set-up sixteen at a time and one by one make the same of meshlets, near, far and across the guard band.
TEST(Meshlets, AreSetUpAlikeEitherWay) {
  shape::Random random(5);
  std::uint64_t boxes = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const OneMeshlet mesh(random, 40);
    const wire::PackedFilm film = mesh.view();
    const EyeMatrix matrix = random_matrix(random, std::pow(10, random.real(-1.5, 1.5)));
    const raster::PatchIdentity identity{7, 1, shape::mirrors(matrix), trial % 2 == 1, false};
    for (const simd::InstructionSet set : simd::all_sets()) {
      MeshletPlacer placer(set);
      placer.place(eye_map(matrix), film, film.meshlets()[0], kView);
      const raster::Picture picture{kView, 320, 180};
      const raster::Made one = raster::set_up(set, picture, placer, identity),
                         other = raster::set_up(set, picture, placer, identity, raster::Way::plainly);
      ASSERT_EQ(one.triangles.size(), other.triangles.size());
      ASSERT_EQ(one.boxes.size(), other.boxes.size());
      EXPECT_TRUE(
          std::ranges::equal(std::as_bytes(std::span(one.triangles)), std::as_bytes(std::span(other.triangles))));
      EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(one.boxes)), std::as_bytes(std::span(other.boxes))));
      boxes += one.edge_boxes;
    }
  }
  EXPECT_GT(boxes, 10'000u);
}

}  // namespace
}  // namespace mars::geometry
